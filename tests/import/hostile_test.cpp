// References that lead out of the asset's folder, in every format that tests can write: not followed, and
// said.
#include <gmock/gmock.h>

#include <functional>

#include "import/gltf_builder.h"
#include "import/image_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using testing::HasSubstr;

// An asset whose one texture is `reference`; more files may be written to `folder`.
struct Format {
  std::string name;
  std::function<std::string(const TempFolder& folder, const std::string& reference)> write;
};

std::string obj(const TempFolder& folder, const std::string& reference) {
  folder.write("in/a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + reference + "\n");
  return "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
}

std::string gltf(const TempFolder& /*folder*/, const std::string& reference) {
  QuadGltf quad;
  quad.root["images"] = {{{"uri", reference}}};
  quad.root["textures"] = {{{"source", 0}}};
  quad.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  quad.root["meshes"][0]["primitives"][0]["material"] = 0;
  return quad.text();
}

std::string collada(const TempFolder& /*folder*/, const std::string& reference) {
  return R"(<?xml version="1.0"?><COLLADA version="1.4.1"><library_images><image id="i"><init_from>)" +
         reference +
         R"(</init_from></image></library_images><library_effects><effect id="e"><profile_COMMON>
<newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam><technique sid="t"><phong><diffuse>
<texture texture="s" texcoord="u"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="1" material="x"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="vs"><node id="n"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="x" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";
}

std::string direct_x(const TempFolder& /*folder*/, const std::string& reference) {
  return "xof 0303txt 0032\nMesh {\n3;\n0;0;0;,\n1;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\nMeshMaterialList "
         "{\n1;\n1;\n0;\n"
         "Material m {\n1;1;1;1;;\n1;\n0;0;0;;\n0;0;0;;\nTextureFilename { \"" +
         reference + "\"; }\n}\n}\nMeshTextureCoords {\n3;\n0;0;,\n1;0;,\n0;1;;\n}\n}\n";
}

std::string ac3d(const TempFolder& /*folder*/, const std::string& reference) {
  return "AC3Db\nMATERIAL \"m\" rgb 1 0 0 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids "
         "1\n"
         "OBJECT poly\nname \"t\"\ntexture \"" +
         reference +
         "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids "
         "0\n";
}

std::string smd(const TempFolder& /*folder*/, const std::string& reference) {
  return "version 1\nnodes\n0 \"root\" -1\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\nend\ntriangles\n" +
         reference + "\n0 0 0 0 0 0 1 0 0\n0 1 0 0 0 0 1 1 0\n0 0 1 0 0 0 1 0 1\nend\n";
}

std::string fbx(const TempFolder& /*folder*/, const std::string& reference) {
  const std::string name = "\"" + reference + "\"";
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
         "Objects:  {\nGeometry: 1, \"Geometry::g\", \"Mesh\" {\nVertices: *9 { a: 0,0,0,1,0,0,0,1,0 }\n"
         "PolygonVertexIndex: *3 { a: 0,1,-3 }\nLayerElementMaterial: 0 {\nMappingInformationType: "
         "\"AllSame\"\n"
         "ReferenceInformationType: \"IndexToDirect\"\nMaterials: *1 { a: 0 }\n}\nLayer: 0 {\nLayerElement:  "
         "{\n"
         "Type: \"LayerElementMaterial\"\nTypedIndex: 0\n}\n}\n}\nModel: 2, \"Model::m\", \"Mesh\" "
         "{\nVersion: 232\n}\n"
         "Material: 3, \"Material::mat\", \"\" {\nVersion: 102\nShadingModel: \"phong\"\n}\n"
         "Texture: 4, \"Texture::t\", \"\" {\nType: \"TextureVideoClip\"\nVersion: 202\nFileName: " +
         name + "\nRelativeFilename: " + name +
         "\n}\n}\nConnections:  {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",3,2\nC: \"OP\",4,3, "
         "\"DiffuseColor\"\n}\n";
}

class References : public testing::TestWithParam<Format> {
 protected:
  References() {
    std::filesystem::create_directories(folder_.path() / "in");
    secret_ = folder_.write("secret.png", png(1, 1, {{9, 8, 7, 6}}));
  }

  mesh::Scene import_with(const std::string& reference) {
    const Format& format = GetParam();
    return import_asset(folder_.write("in/" + format.name, format.write(folder_, reference)), {},
                        Textures::kDecode);
  }

  const TempFolder folder_;
  std::filesystem::path secret_;
};

TEST_P(References, APictureInTheFolderIsRead) {
  folder_.write("in/mine.png", png(1, 1, {{1, 2, 3, 4}}));
  const mesh::Scene scene = import_with("mine.png");
  ASSERT_EQ(scene.textures.size(), 1u);
  ASSERT_EQ(scene.textures[0].pixels.size(), 4u);
  EXPECT_EQ(scene.textures[0].pixels[0], 1);
}

TEST_P(References, APictureBeyondItIsNotReadAndThatIsSaid) {
  std::filesystem::create_symlink(secret_, folder_.path() / "in/link.png");
  std::filesystem::create_directory_symlink(folder_.path(), folder_.path() / "in/folder");
  for (const std::string& reference :
       {std::string("../secret.png"), secret_.string(), std::string("link.png"),
        std::string("folder/secret.png"), std::string("http://localhost/a.png")}) {
    SCOPED_TRACE(reference);
    const mesh::Scene scene = import_with(reference);
    EXPECT_TRUE(mentions(scene.warnings, "out of the asset's folder"))
        << testing::PrintToString(scene.warnings);
    for (const mesh::Texture& texture : scene.textures) EXPECT_TRUE(texture.pixels.empty()) << "it was read";
    for (const mesh::ReferencedFile& file : scene.files)
      EXPECT_THAT(file.path, testing::Not(HasSubstr("secret")));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, References,
                         testing::Values(Format{"a.obj", obj}, Format{"a.gltf", gltf},
                                         Format{"a.dae", collada}, Format{"a.x", direct_x},
                                         Format{"a.ac", ac3d}, Format{"a.smd", smd}, Format{"a.fbx", fbx}),
                         [](const auto& test) { return test.param.name.substr(2); });

// A format whose files name others that hold the geometry.
TEST(HostileScenes, MeshesBeyondTheFolderAreNotReadAndThatIsSaid) {
  const TempFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("secret.obj", mesh);
  folder.write("in/mine.obj", mesh);
  const auto scene_with = [&](const std::string& name) {
    return import_asset(folder.write("in/a.lws", "LWSC\n5\n\nLoadObjectLayer 1 10000000 " + name +
                                                     "\nShowObject 7 -1\nObjectMotion\nNumChannels 0\n\n"));
  };
  EXPECT_EQ(scene_with("mine.obj").meshes.size(), 1u);
  const mesh::Scene scene = scene_with("../secret.obj");
  EXPECT_TRUE(scene.meshes.empty());
  EXPECT_TRUE(mentions(scene.warnings, "out of the asset's folder"));
}

TEST(HostileBuffers, OutsideOfTheFolderTheyAreAnError) {
  const TempFolder folder;
  const std::vector<std::uint8_t> bytes = QuadGltf().buffer();
  const std::filesystem::path outside = folder.write("outside.bin", std::string(bytes.begin(), bytes.end()));
  std::filesystem::create_directory(folder.path() / "in");
  std::filesystem::create_symlink(outside, folder.path() / "in/link.bin");
  for (const std::string& uri : {std::string("../outside.bin"), outside.string(), std::string("link.bin"),
                                 std::string("%2e%2e/outside.bin"), std::string("..%5Coutside.bin")}) {
    QuadGltf quad;
    quad.root["buffers"][0]["uri"] = uri;
    EXPECT_THAT(refusal(folder.write("in/a.gltf", quad.text())), HasSubstr("leads out of the asset's folder"))
        << uri;
  }
}

TEST(HostileNumbers, WhatIsNotFiniteIsAWarning) {
  const TempFolder folder;
  QuadGltf quad;
  quad.positions[0] = std::numeric_limits<float>::quiet_NaN();
  quad.positions[4] = -std::numeric_limits<float>::infinity();
  const mesh::Scene scene = import_asset(folder.write("a.glb", quad.binary()));
  EXPECT_TRUE(mentions(scene.warnings, "2 vertices of 1 mesh with coordinates that are no finite numbers"));
}

TEST(HostileSizes, MoreTrianglesThanAllowedAreRefused) {
  const TempFolder folder;
  const std::filesystem::path gltf = folder.write("a.gltf", QuadGltf().text());
  const std::filesystem::path obj = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n");
  for (const std::filesystem::path& asset : {gltf, obj}) {
    EXPECT_EQ(refusal(asset, {.triangles = 2}), "");
    EXPECT_THAT(refusal(asset, {.triangles = 1}),
                HasSubstr("holds 2 triangles, more than the limit of 1 (--max-triangles)"));
  }
}

TEST(HostileObj, FacesThatAssimpDropsAreNotSilence) {
  const TempFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  EXPECT_THAT(refusal(folder.write("a.obj", vertices + "f 1/1/1 2/1/1 \\\n3/1/1\n")),
              HasSubstr("Assimp reads 0 triangles of a file with 1 faces"));
  EXPECT_EQ(refusal(folder.write("b.obj", vertices + "f 1//1 2//1 3//1\n# f 1 2 3\nf 1 2\n")), "");
}

TEST(HostileObj, IndentedLinesCount) {
  const TempFolder folder;
  const mesh::Scene scene = import_asset(
      folder.write("a.obj", " v 5 0 0\n\tv 1 0 0\nv 0 1 0\r\n  \n # f 1 1 1\n\t f 1\\\n 2\\\n 3\nf 1 3 2"));
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 2u);
  EXPECT_EQ(scene.meshes.at(0).positions[0], 5.0f);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST(HostileUtf16, FormatsThatDoNotReadItSaySo) {
  const TempFolder folder;
  EXPECT_THAT(refusal(folder.write("a.ac", std::string("\xFF\xFE"
                                                       "A\0C\0",
                                                       6))),
              HasSubstr("is UTF-16 text"));
}

}  // namespace
}  // namespace scene_analyzer::import
