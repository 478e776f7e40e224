#include "asset_seeds.h"

#include <assimp/cexport.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <stdexcept>

#include "import/gltf_builder.h"
#include "import/model_builder.h"

namespace scene_analyzer::fuzz {
namespace {

// Names of Assimp's exporters whose files Assimp reads again.
constexpr std::array kExporters = {"collada", "x",    "obj", "stl", "stlb",   "ply",  "plyb",
                                   "3ds",     "glb2", "glb", "x3d", "assbin", "fbxa", "3mf"};

// Two instances of a quad below two nodes, with a material and a second mesh.
std::string rich_glb() {
  import::QuadGltf gltf;
  gltf.root["materials"] = {{{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}}};
  gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.root["meshes"].push_back(
      {{"name", "Strip"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}}}}});
  gltf.root["nodes"] = {{{"name", "root"}, {"children", {1, 2}}},
                        {{"name", "left"}, {"mesh", 0}, {"translation", {1, 2, 3}}},
                        {{"name", "right"}, {"mesh", 0}, {"scale", {2, 2, 2}}, {"children", {3}}},
                        {{"name", "below"}, {"mesh", 1}}};
  return gltf.binary();
}

std::vector<SeedAsset> exported() {
  const std::string glb = rich_glb();
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  std::vector<SeedAsset> assets;
  Assimp::Exporter exporter;
  for (std::size_t i = 0; i < exporter.GetExportFormatCount(); ++i) {
    const aiExportFormatDesc* format = exporter.GetExportFormatDescription(i);
    for (const char* wanted : kExporters) {
      if (std::string(wanted) != format->id) continue;
      const aiExportDataBlob* blob = exporter.ExportToBlob(scene, format->id);
      if (blob == nullptr || blob->size == 0) continue;
      assets.push_back({std::string(".") + format->fileExtension,
                        std::string(static_cast<const char*>(blob->data), blob->size)});
    }
  }
  return assets;
}

}  // namespace

std::vector<SeedAsset> seed_assets() {
  std::vector<SeedAsset> assets = exported();
  const std::string obj =
      "mtllib a.mtl\no quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl red\nf 1/1/1 2/1/1 "
      "3/1/1 "
      "4/1/1\ng other\nf -1 -2 -3\n";
  const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const std::string nff = "v\nfrom 0 0 1\nat 0 0 0\nup 0 1 0\nf 1 0 0 1 0 0 0 0\np 3\n0 0 0\n1 0 0\n0 1 0\n";
  const std::string ac =
      "AC3Db\nMATERIAL \"m\" rgb 1 0 0 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n"
      "OBJECT poly\nname \"t\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 "
      "0\n1 1 0\n"
      "2 0 1\nkids 0\n";
  const std::string smd =
      "version 1\nnodes\n0 \"root\" -1\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\nend\ntriangles\nm\n0 0 0 0 0 0 "
      "1 0 0\n"
      "0 1 0 0 0 0 1 1 0\n0 0 1 0 0 0 1 0 1\nend\n";
  const std::string text_ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::vector<SeedAsset> built = {{".gltf", import::QuadGltf().text()},
                                        {".glb", import::QuadGltf().binary()},
                                        {".stl", import::binary_stl(4)},
                                        {".ply", import::binary_ply(4)},
                                        {".ply", text_ply},
                                        {".obj", obj},
                                        {".off", off},
                                        {".nff", nff},
                                        {".ac", ac},
                                        {".smd", smd}};
  assets.insert(assets.end(), built.begin(), built.end());
  return assets;
}

}  // namespace scene_analyzer::fuzz
