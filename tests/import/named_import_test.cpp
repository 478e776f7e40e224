// Assets whose files lie under numbers, imported: the same scene as under their true names, and no word of
// where they lie.
#include <gmock/gmock.h>

#include <algorithm>

#include "import/file_names.h"
#include "import/gltf_builder.h"
#include "import/image_builder.h"
#include "import/same_scene.h"
#include "import/temp_folder.h"
#include "support/numbered_files.h"

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const Pixels kFour = {{255, 0, 0, 255}, {0, 255, 0, 128}, {0, 0, 255, 0}, {10, 20, 30, 40}};

std::string bytes_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

// Two textured meshes below each other, with everything in files of their own.
QuadGltf room_gltf() {
  QuadGltf room;
  room.root["buffers"][0]["uri"] = "parts/room%20one.bin";
  room.root["images"] = {{{"uri", "wood%20grain.png"}}, {{"uri", "parts/wall.tga"}}};
  room.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
  for (int i = 0; i < 2; ++i)
    room.root["materials"].push_back(
        {{"name", i == 0 ? "wood" : "wall"},
         {"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", i}}}, {"baseColorFactor", {0.25, 0.5, i == 0 ? 0.75 : 1.0, 1}}}}});
  nlohmann::json second = room.root["meshes"][0];
  second["name"] = "Wall";
  room.root["meshes"].push_back(second);
  for (int i = 0; i < 2; ++i) room.root["meshes"][i]["primitives"][0]["material"] = i;
  room.root["nodes"] = {{{"name", "floor"}, {"mesh", 0}, {"translation", {1, 2, 3}}, {"children", {1}}},
                        {{"name", "wall"}, {"mesh", 1}, {"scale", {2, 3, 0.1}}}};
  return room;
}

NamedContents gltf_files() {
  const QuadGltf room = room_gltf();
  return {{"room.gltf", room.root.dump()},
          {"wood grain.png", png(2, 2, kFour)},
          {"parts/wall.tga", tga(4, 1, kFour)},
          {"parts/room one.bin", bytes_of(room.buffer())}};
}

NamedContents obj_files() {
  return {
      {"Stuhl äöü.obj",
       "mtllib parts\\colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2.5\nvt 0.25 0.5\no seat\nusemtl red\n"
       "f 1/1 2/1 3/1\no back\nusemtl plain\nf 1 2 4\nf 1 3 4\n"},
      {"parts/colours.mtl", "newmtl red\nKd 1 0.5 0\nmap_Kd my picture.png\nnewmtl plain\nKd 0 0 1\n"},
      {"my picture.png", png(2, 2, kFour)}};
}

class NamedImportTest : public testing::Test {
 protected:
  mesh::AssetSource numbered(const NamedContents& files) {
    mesh::AssetSource asset = write_numbered(numbered_, files);
    write_file_names(numbered_.path(), *asset.file_names);
    return asset;
  }
  // Imported both ways, compared; the one through the table.
  mesh::Scene same(const NamedContents& files) {
    mesh::Scene named = import_asset(write_named(named_, files), {}, Textures::kDecode);
    mesh::Scene scene = import_asset(numbered(files), {}, Textures::kDecode);
    expect_same_scene(scene, named);
    EXPECT_EQ(scene.asset, files.front().first);
    return scene;
  }
  // What the import is refused with, or else all its warnings, one a line; of files where `missing` is not.
  std::string said(NamedContents files, const std::string& missing = "") {
    std::erase_if(files, [&](const auto& file) { return file.first == missing; });
    const TempFolder folder;
    const mesh::AssetSource asset = write_numbered(folder, files);
    write_file_names(folder.path(), *asset.file_names);
    std::string all;
    try {
      for (const std::string& warning : import_asset(asset, {}, Textures::kDecode).warnings)
        all += warning + '\n';
    } catch (const InputError& error) {
      all = error.what();
    }
    EXPECT_THAT(all, Not(HasSubstr(folder.path().string())));
    EXPECT_THAT(all, Not(HasSubstr("0.g")));
    EXPECT_THAT(all, Not(HasSubstr("0.o")));
    return all;
  }

  TempFolder named_, numbered_;
};

std::vector<std::string> files_of(const mesh::Scene& scene, bool found) {
  std::vector<std::string> names;
  for (const mesh::ReferencedFile& file : scene.files)
    if (file.found == found) names.push_back(file.path);
  return names;
}

TEST_F(NamedImportTest, GltfWithBufferAndTextures) {
  const mesh::Scene scene = same(gltf_files());
  EXPECT_THAT(scene.warnings, IsEmpty());
  ASSERT_THAT(scene.instances, SizeIs(2));
  EXPECT_EQ(scene.instances[1].node, "wall");
  EXPECT_EQ(scene.instances[1].world[5], 3);
  EXPECT_EQ(scene.meshes.at(1).triangle_count(), 2u);
  ASSERT_THAT(scene.textures, SizeIs(2));
  for (const mesh::Texture& texture : scene.textures) EXPECT_EQ(texture.pixels.size(), 16u) << texture.path;
  EXPECT_THAT(files_of(scene, true), testing::UnorderedElementsAre("room.gltf", "parts/room one.bin",
                                                                   "wood grain.png", "parts/wall.tga"));
  EXPECT_THAT(files_of(scene, false), IsEmpty());
}

TEST_F(NamedImportTest, ObjWithMaterialsAndTexture) {
  const mesh::Scene scene = same(obj_files());
  EXPECT_THAT(scene.warnings, IsEmpty());
  ASSERT_THAT(scene.meshes, SizeIs(2));
  const mesh::Material& red = scene.materials.at(scene.meshes[0].material);
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(scene.textures.at(red.texture.value()).pixels.size(), 16u);
  EXPECT_THAT(files_of(scene, true), ElementsAre("Stuhl äöü.obj", "parts/colours.mtl", "my picture.png"));
}

// What is read in place of the asset itself has to be found under its name, too.
TEST_F(NamedImportTest, ObjWithIndentedLines) {
  NamedContents files = obj_files();
  std::string& text = files.front().second;
  for (std::size_t at = text.find("\nv "); at != std::string::npos; at = text.find("\nv ", at + 1))
    text.insert(at + 1, "  ");
  EXPECT_THAT(same(files).meshes, SizeIs(2));
}

TEST_F(NamedImportTest, BinaryGltf) {
  QuadGltf quad = room_gltf();
  quad.root["buffers"][0].erase("uri");
  EXPECT_THAT(same({{"ROOM.GLB", quad.binary()}, {"wood grain.png", png(2, 2, kFour)}}).warnings,
              ElementsAre(HasSubstr("\"parts/wall.tga\" is missing")));
}

TEST_F(NamedImportTest, ContentsDecideWithoutAnExtension) {
  const mesh::Scene scene = same({{"plain", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}});
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 1u);
}

// Assimp tries the asset's own name with another extension.
TEST_F(NamedImportTest, AMaterialFileThatIsGuessedFromTheAssetsName) {
  const std::string obj = "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  const std::string red = "newmtl red\nKd 1 0 0\n";
  const mesh::Scene scene = same({{"room.obj", obj}, {"room.mtl", red}});
  EXPECT_EQ(scene.materials.at(scene.meshes.at(0).material).base_color, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_THAT(files_of(scene, true), Contains("room.mtl"));
  const TempFolder folder;
  const mesh::AssetSource asset = write_numbered(folder, {{"room.obj", obj}, {"0.mtl", red}});
  write_file_names(folder.path(), *asset.file_names);
  const mesh::Scene without = import_asset(asset);
  EXPECT_EQ(files_of(without, true), std::vector<std::string>{"room.obj"}) << "nor from its number";
  EXPECT_THAT(without.warnings, ElementsAre("material file \"none.mtl\" is missing"));
}

// An MD5 mesh's animation and camera are never named.
TEST_F(NamedImportTest, CompanionsThatAreNotNamedAtAll) {
  const std::string mesh =
      "MD5Version 10\ncommandline \"\"\nnumJoints 1\nnumMeshes 1\njoints {\n"
      "\"origin\" -1 ( 0 0 0 ) ( 0 0 0 )\n}\nmesh {\nshader \"skin\"\nnumverts 3\n"
      "vert 0 ( 0 0 ) 0 1\nvert 1 ( 1 0 ) 1 1\nvert 2 ( 0 1 ) 2 1\nnumtris 1\ntri 0 0 1 2\nnumweights 3\n"
      "weight 0 0 1 ( 0 0 0 )\nweight 1 0 1 ( 1 0 0 )\nweight 2 0 1 ( 0 1 0 )\n}\n";
  const mesh::Scene scene = same({{"guard.md5mesh", mesh}, {"guard.md5anim", "MD5Version 10\n"}});
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 1u);
  EXPECT_THAT(files_of(scene, true), Contains("guard.md5anim"));
}

TEST_F(NamedImportTest, MissingFilesAreNamedAsTheAssetDoes) {
  EXPECT_EQ(said(gltf_files(), "parts/room one.bin"),
            "room.gltf: the file \"parts/room%20one.bin\" that holds its geometry (buffer 0) is missing");
  EXPECT_EQ(said(gltf_files(), "wood grain.png"),
            "texture \"wood%20grain.png\" is missing or cannot be read\n");
  EXPECT_EQ(said(obj_files(), "parts/colours.mtl"), "material file \"parts/colours.mtl\" is missing\n");
  EXPECT_EQ(said(obj_files(), "my picture.png"), "texture \"my picture.png\" is missing or cannot be read\n");
}

TEST_F(NamedImportTest, FilesThatAreGoneAreMissing) {
  const mesh::AssetSource obj = numbered(obj_files());
  fs::remove(numbered_.path() / "1");
  EXPECT_THAT(import_asset(obj).warnings, ElementsAre("material file \"parts/colours.mtl\" is missing"));
}

TEST_F(NamedImportTest, DamagedFilesAreNamedAsTheAssetDoes) {
  NamedContents files = gltf_files();
  files[1].second = "no picture";
  EXPECT_THAT(said(files), HasSubstr("texture \"wood%20grain.png\" cannot be decoded"));
  files[3].second.resize(10);
  EXPECT_EQ(said(files), "room.gltf: buffer 0 promises 60 bytes and holds 10");
  for (const char* contents : {"", "{", "nonsense", "version https://git-lfs.github.com/spec/v1\n"})
    EXPECT_THAT(said({{"room.gltf", contents}}), testing::StartsWith("room.gltf: ")) << contents;
}

TEST_F(NamedImportTest, ReferencesThatLeadOutAreRefused) {
  numbered_.write("secret.bin", std::string(60, '\0'));
  for (const std::string& uri : {std::string("../secret.bin"), std::string("/etc/passwd"),
                                 std::string("%2e%2e/secret.bin"), (numbered_.path() / "1").string()}) {
    QuadGltf quad;
    quad.root["buffers"][0]["uri"] = uri;
    const mesh::AssetSource asset = write_numbered(numbered_, {{"room.gltf", quad.root.dump()}});
    fs::remove(numbered_.path() / kFileNames);
    write_file_names(numbered_.path(), *asset.file_names);
    try {
      import_asset(asset);
      FAIL() << uri;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "room.gltf: buffer 0 is \"" + uri +
                                  "\", which leads out of the asset's folder and is not followed");
    }
  }
  EXPECT_THAT(said({{"a.obj", "mtllib ../a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}}),
              HasSubstr("reference \"../a.mtl\" leads out of the asset's folder and was not followed"));
}

// The numbers, the table itself and what else lies there.
TEST_F(NamedImportTest, FilesOfNoNameAreNotRead) {
  for (const char* name : {"1", "names", "0.gltf", "other.bin"}) {
    QuadGltf quad;
    quad.root["buffers"][0]["uri"] = name;
    const TempFolder folder;
    const mesh::AssetSource asset =
        write_numbered(folder, {{"room.gltf", quad.root.dump()}, {"a.bin", bytes_of(quad.buffer())}});
    write_file_names(folder.path(), *asset.file_names);
    folder.write("other.bin", bytes_of(quad.buffer()));
    try {
      import_asset(asset);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("\"" + std::string(name) + "\" that holds its geometry")) << name;
    }
  }
}

TEST_F(NamedImportTest, ATableThatCannotBeReadIsRefused) {
  const mesh::AssetSource asset = numbered(gltf_files());
  const auto refused = [&] {
    try {
      import_asset(asset);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string whole = TemporaryFolder::read(numbered_.path() / kFileNames);
  numbered_.write(kFileNames, whole.substr(0, whole.size() - 3));
  EXPECT_EQ(refused(), "room.gltf: the names of the asset's files are damaged");
  numbered_.write(kFileNames, "");
  EXPECT_EQ(refused(), "room.gltf: the names of the asset's files are damaged");
  fs::remove(numbered_.path() / kFileNames);
  EXPECT_EQ(refused(), "room.gltf: the names of the asset's files cannot be read: No such file or directory");
  numbered_.write(kFileNames, whole);
  EXPECT_EQ(refused(), "");
}

}  // namespace
}  // namespace scene_analyzer::import
