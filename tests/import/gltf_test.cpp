// glTF files that are broken in one place each: right, put right, or refused by name.
#include <gmock/gmock.h>

#include "import/gltf_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

std::string refusal_of(const QuadGltf& quad) {
  const TempFolder folder;
  return refusal(folder.write("quad.gltf", quad.text()));
}

mesh::Scene scene_of(const QuadGltf& quad) {
  const TempFolder folder;
  return import_asset(folder.write("quad.gltf", quad.text()));
}

TEST(ImportGltf, TheQuadItself) {
  const QuadGltf quad;
  const TempFolder folder;
  for (const std::filesystem::path& asset :
       {folder.write("a.gltf", quad.text()), folder.write("b.glb", quad.binary()),
        folder.write("C.GLB", quad.binary())}) {
    const mesh::Scene scene = import_asset(asset);
    EXPECT_THAT(scene.meshes.at(0).positions, ElementsAreArray(quad.positions));
    EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_EQ(scene.format, "glTF2");
    EXPECT_EQ(scene.unit_scale, 1.0);
    EXPECT_EQ(scene.up_axis, "+Y");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_FALSE(scene.materials.at(scene.meshes[0].material).base_color) << "the file has no material";
  }
}

TEST(ImportGltf, MaterialColourAndEmbeddedTexture) {
  QuadGltf quad;
  quad.root["materials"] = {
      {{"name", "m"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.25, 0.5, 0.75, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
  quad.root["textures"] = {{{"source", 0}}};
  quad.root["images"] = {{{"uri", "data:image/png;base64,iVBORw0="}}};
  quad.root["meshes"][0]["primitives"][0]["material"] = 0;
  const mesh::Scene scene = scene_of(quad);
  const mesh::Material& material = scene.materials.at(scene.meshes.at(0).material);
  EXPECT_THAT(material.base_color.value(), ElementsAre(0.25f, 0.5f, 0.75f, 1.0f));
  EXPECT_THAT(scene.textures.at(material.texture.value()).encoded, ElementsAre(0x89, 'P', 'N', 'G', '\r'));
}

TEST(ImportGltf, ExternalBuffer) {
  QuadGltf quad;
  const std::vector<std::uint8_t> bytes = quad.buffer();
  const std::string contents(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const TempFolder folder;
  quad.root["buffers"][0]["uri"] = "sub/my%20quad.bin";
  const std::filesystem::path asset = folder.write("quad.gltf", quad.text());
  EXPECT_THAT(refusal(asset), HasSubstr("quad.gltf: the file \"sub/my%20quad.bin\" that holds its geometry"));
  folder.write("sub/my quad.bin", contents.substr(0, 59));
  EXPECT_THAT(refusal(asset), HasSubstr("buffer 0 promises 60 bytes and holds 59"));
  folder.write("sub/my quad.bin", contents);
  const mesh::Scene scene = import_asset(asset);
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 2u);
  ASSERT_EQ(scene.files.size(), 2u);
  EXPECT_EQ(scene.files[1].path, "sub/my quad.bin");
}

TEST(ImportGltf, BuffersFromElsewhereAreRefused) {
  for (const auto& [uri, reason] : {std::pair{"../x.bin", "leads out of the asset's folder"},
                                    {"/etc/passwd", "leads out of the asset's folder"},
                                    {"%2e%2e/x.bin", "leads out of the asset's folder"},
                                    {"http://127.0.0.1:9/x.bin", "is the address"}}) {
    QuadGltf quad;
    quad.root["buffers"][0]["uri"] = uri;
    EXPECT_THAT(refusal_of(quad), HasSubstr(reason)) << uri;
  }
}

TEST(ImportGltf, LyingSizesAreRefused) {
  QuadGltf quad;
  quad.root["accessors"][0]["count"] = 5;
  EXPECT_THAT(refusal_of(quad), HasSubstr("accessor 0 counts 5 elements"));
  quad = {};
  quad.root["bufferViews"][1]["byteLength"] = 13;
  EXPECT_THAT(refusal_of(quad), HasSubstr("buffer view 1 ends at byte 48 + 13 of a buffer of 60"));
  quad = {};
  quad.root["bufferViews"][0]["byteStride"] = 8;
  EXPECT_THAT(refusal_of(quad), HasSubstr("stride of 8 bytes"));
  quad = {};
  quad.root["buffers"][0]["byteLength"] = 61;
  EXPECT_THAT(refusal_of(quad), HasSubstr("promises 61 bytes"));
  quad = {};
  quad.root["accessors"][0]["count"] = -4;
  EXPECT_THAT(refusal_of(quad), HasSubstr("not a whole number"));
  quad = {};
  quad.root["accessors"][0]["byteOffset"] = 18446744073709551615u;
  EXPECT_THAT(refusal_of(quad), HasSubstr("accessor 0 counts"));
}

TEST(ImportGltf, IndicesBeyondTheVerticesAreRefused) {
  QuadGltf quad;
  quad.indices[4] = 4;
  EXPECT_THAT(refusal_of(quad), HasSubstr("mesh 0 primitive 0 asks for vertex 4 of 4 (triangle 1)"));
}

TEST(ImportGltf, LeftOverCornersAreAWarning) {
  QuadGltf quad;
  quad.root["accessors"][1]["count"] = 5;
  const mesh::Scene scene = scene_of(quad);
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 1u);
  EXPECT_TRUE(mentions(scene.warnings, "5 corners"));
}

TEST(ImportGltf, PrimitiveModes) {
  const auto triangles = [](int mode) {
    QuadGltf quad;
    quad.root["meshes"][0]["primitives"][0]["mode"] = mode;
    const mesh::Scene scene = scene_of(quad);
    std::vector<std::uint32_t> indices(scene.meshes.at(0).indices.begin(), scene.meshes.at(0).indices.end());
    return indices;
  };
  EXPECT_THAT(triangles(4), ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(triangles(5), ElementsAre(0, 1, 2, 2, 1, 0, 2, 0, 2, 2, 0, 3));
  EXPECT_THAT(triangles(6), ElementsAre(0, 1, 2, 0, 2, 0, 0, 0, 2, 0, 2, 3));
  for (const int mode : {0, 1, 2, 3}) EXPECT_THAT(triangles(mode), ElementsAre()) << mode;
  QuadGltf quad;
  quad.root["meshes"][0]["primitives"][0]["mode"] = 9;
  EXPECT_THAT(refusal_of(quad), HasSubstr("unknown mode 9"));
}

TEST(ImportGltf, QuantisedPositionsAreRefused) {
  QuadGltf quad;
  quad.root["accessors"][0]["componentType"] = 5122;
  EXPECT_THAT(refusal_of(quad), HasSubstr("not three floats"));
}

TEST(ImportGltf, SparseValuesReplaceWhatTheyStandFor) {
  QuadGltf quad;
  // Vertex 2 (indices hold a 2 at byte 4 of their view) becomes vertex 1's position.
  quad.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"byteOffset", 4}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}, {"byteOffset", 12}}}};
  const mesh::Scene scene = scene_of(quad);
  EXPECT_THAT(scene.meshes.at(0).positions, ElementsAre(0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0));
  quad.root["accessors"][0].erase("bufferView");
  EXPECT_THAT(scene_of(quad).meshes.at(0).positions, ElementsAre(0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0));
  quad.root["accessors"][0]["sparse"]["count"] = 5;
  EXPECT_THAT(refusal_of(quad), HasSubstr("replaces more elements"));
}

TEST(ImportGltf, AnAccessorWithoutDataIsRefused) {
  QuadGltf quad;
  quad.root["accessors"][0].erase("bufferView");
  EXPECT_THAT(refusal_of(quad), HasSubstr("accessor 0 has no buffer view"));
}

TEST(ImportGltf, NodesThatAreNoTree) {
  QuadGltf quad;
  quad.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
  EXPECT_THAT(refusal_of(quad), HasSubstr("cycle"));
  quad.root["nodes"] = {{{"children", {1, 2}}}, {{"children", {3}}}, {{"children", {3}}}, {{"mesh", 0}}};
  const mesh::Scene scene = scene_of(quad);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(mentions(scene.warnings, "several parents"));
  quad.root["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 40; ++i) quad.root["nodes"].push_back({{"children", {i + 1, i + 1}}});
  quad.root["nodes"].push_back({{"mesh", 0}});
  EXPECT_THAT(refusal_of(quad), HasSubstr("ten million"));
  quad.root["nodes"] = {{{"mesh", 3}}};
  EXPECT_THAT(refusal_of(quad), HasSubstr("mesh 3, which does not exist"));
}

TEST(ImportGltf, TheFirstSceneIsShownWhenNoneIsNamed) {
  QuadGltf quad;
  quad.root.erase("scene");
  EXPECT_EQ(scene_of(quad).instances.size(), 1u);
  quad.root.erase("scenes");
  EXPECT_THAT(refusal_of(quad), HasSubstr("has no scene"));
}

TEST(ImportGltf, MeshesThatNoNodeShowsAreNotInstances) {
  QuadGltf quad;
  quad.root["meshes"].push_back(quad.root["meshes"][0]);
  const mesh::Scene scene = scene_of(quad);
  EXPECT_EQ(scene.instances.size(), 1u);
}

// Assimp 5.2.5 crashes on these, which are valid: the matrices of a skin are optional.
TEST(ImportGltf, SkinsWithoutMatricesAreReadInTheirRestPose) {
  QuadGltf quad;
  quad.root["skins"] = {{{"joints", {1}}}};
  quad.root["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"name", "joint"}}};
  quad.root["scenes"][0]["nodes"] = {0, 1};
  for (const int accessor : {2, 3}) {
    quad.root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", accessor == 2 ? 16 : 64}});
    quad.root["accessors"].push_back({{"bufferView", accessor},
                                      {"componentType", accessor == 2 ? 5121 : 5126},
                                      {"count", 4},
                                      {"type", "VEC4"}});
  }
  quad.positions.resize(16, 0);  // room for the weights' view; what they say does not matter
  quad.root["buffers"][0]["byteLength"] = 76;
  quad.root["bufferViews"][1]["byteOffset"] = 64;
  quad.root["meshes"][0]["primitives"][0]["attributes"].update({{"JOINTS_0", 2}, {"WEIGHTS_0", 3}});
  const TempFolder folder;
  for (const std::filesystem::path& asset :
       {folder.write("a.gltf", quad.text()), folder.write("b.glb", quad.binary())}) {
    const mesh::Scene scene = import_asset(asset);
    EXPECT_EQ(scene.meshes.at(0).triangle_count(), 2u);
    EXPECT_EQ(scene.instances.at(0).world, mesh::kIdentity4);
  }
}

TEST(ImportGltf, BrokenContainers) {
  const std::string whole = QuadGltf().binary();
  const TempFolder folder;
  for (std::size_t size = 1; size < whole.size(); size += size < 32 ? 1 : 7)
    EXPECT_NE(refusal(folder.write("cut.glb", whole.substr(0, size))), "") << size;
  EXPECT_EQ(refusal(folder.write("whole.glb", whole)), "");
  const mesh::Scene longer = import_asset(folder.write("longer.glb", whole + std::string(100, 'x')));
  EXPECT_TRUE(mentions(longer.warnings, "GLB header says"));
  std::string version = whole;
  version[4] = 7;
  EXPECT_THAT(refusal(folder.write("version.glb", version)), HasSubstr("version 7"));
  EXPECT_THAT(refusal(folder.write("bad.gltf", "{\"asset\": {")),
              HasSubstr("its JSON is broken: parse error"));
  EXPECT_THAT(refusal(folder.write("list.gltf", "[]")), HasSubstr("not an object"));
  EXPECT_NE(refusal(folder.write("deep.gltf", std::string(200000, '['))), "");
}

}  // namespace
}  // namespace scene_analyzer::import
