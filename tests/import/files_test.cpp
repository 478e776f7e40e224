// What is wrong with a file before anything is imported, and which files an asset is made of.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "import/gltf_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

bool has_file(const mesh::Scene& scene, const std::string& path, bool found) {
  for (const mesh::ReferencedFile& file : scene.files)
    if (file.path == path && file.found == found) return true;
  return false;
}

TEST(ImportFiles, MissingFolderEmptyAndUnsupportedAreToldApart) {
  const TempFolder folder;
  EXPECT_THAT(refusal(folder.path() / "none.obj"), HasSubstr("none.obj: no such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(folder.write("empty.obj", "")), HasSubstr("empty.obj: is empty"));
  EXPECT_THAT(refusal(folder.write("notes.txt", kTriangle)), HasSubstr("unsupported format \".txt\""));
  EXPECT_THAT(refusal(folder.write("below.obj/x.obj", kTriangle).parent_path()), HasSubstr("is a folder"));
}

TEST(ImportFiles, AFifoIsNotWaitedFor) {
  const TempFolder folder;
  const std::filesystem::path fifo = folder.path() / "pipe.obj";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_THAT(refusal(fifo), HasSubstr("not a regular file"));
}

TEST(ImportFiles, UnreadableFileSaysSo) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  const TempFolder folder;
  const std::filesystem::path file = folder.write("secret.obj", kTriangle);
  ASSERT_EQ(chmod(file.c_str(), 0), 0);
  EXPECT_THAT(refusal(file), HasSubstr("Permission denied"));
}

TEST(ImportFiles, MessagesNameTheFileAndAreOneLine) {
  const TempFolder folder;
  const std::string message = refusal(folder.write("new\nline.glb", "glTF"));
  EXPECT_THAT(message, StartsWith(folder.path().string()));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(ImportFiles, WrongContentsAreNamed) {
  const TempFolder folder;
  EXPECT_THAT(refusal(folder.write("a.glb", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n")),
              HasSubstr("Git LFS pointer"));
  EXPECT_THAT(refusal(folder.write("b.stl", "<!DOCTYPE html>\n<html>")), HasSubstr("web page"));
  EXPECT_THAT(refusal(folder.write("c.obj", "\x89PNG\r\n\x1a\nxxxx")), HasSubstr("PNG image"));
  EXPECT_THAT(refusal(folder.write("d.obj", QuadGltf().binary())), HasSubstr("rename it to .glb"));
  EXPECT_THAT(refusal(folder.write("e.obj", "\xFF\xFEv\0 \0")), HasSubstr("UTF-16"));
  EXPECT_THAT(refusal(folder.write("f.glb", "solid x")), HasSubstr("does not start with \"glTF\""));
  EXPECT_THAT(refusal(folder.write("noise", "\x01\x02\x03\x04")), HasSubstr("no known format"));
}

// Found by fuzzing: Assimp quotes what it cannot read, to the end of the file.
TEST(ImportFiles, ReasonsAreShortWhateverIsInTheFile) {
  const TempFolder folder;
  const std::filesystem::path file =
      folder.write("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex x" + std::string(5000, 'y') +
                                "\nendsolid a\n");
  const std::string message = refusal(file);
  EXPECT_THAT(message, HasSubstr("Cannot parse string"));
  EXPECT_LT(message.size(), file.string().size() + 400);
  EXPECT_TRUE(message.ends_with("...")) << message;
}

TEST(ImportFiles, ContentsDecideWithoutAnExtension) {
  const TempFolder folder;
  EXPECT_EQ(import_asset(folder.write("plain", kTriangle)).meshes.at(0).triangle_count(), 1u);
}

TEST(ImportFiles, NamesMayHoldAnything) {
  const TempFolder folder;
  for (const char* name :
       {"-rf.obj", "Stuhl äöü.obj", "back\\slash.obj", "per%20cent.obj", "..hidden.obj", "UPPER.OBJ"})
    EXPECT_EQ(refusal(folder.write(name, kTriangle)), "") << name;
}

TEST(ImportFiles, RelativePathsStartAtTheCurrentFolder) {
  const TempFolder folder;
  folder.write("below/a.obj", kTriangle);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(refusal("below/a.obj"), "");
  EXPECT_EQ(refusal("./below/../below/a.obj"), "");
  std::filesystem::current_path(folder.path() / "below");
  EXPECT_EQ(refusal("a.obj"), "");
  std::filesystem::current_path(before);
}

TEST(ImportFiles, TheAssetMayBeALink) {
  const TempFolder store, folder;
  const std::filesystem::path target = store.write("content.obj", kTriangle);
  std::filesystem::create_symlink(target, folder.path() / "link.obj");
  EXPECT_EQ(refusal(folder.path() / "link.obj"), "");
}

TEST(ImportFiles, AMissingMaterialFileIsAWarning) {
  const TempFolder folder;
  const mesh::Scene scene = import_asset(folder.write("a.obj", std::string("mtllib none.mtl\n") + kTriangle));
  EXPECT_TRUE(mentions(scene.warnings, "\"none.mtl\" is missing"));
  EXPECT_EQ(scene.warnings.size(), 1u) << "the fallback to a.mtl is nobody's concern";
  EXPECT_EQ(scene.files.at(0).path, "a.obj");
  EXPECT_TRUE(has_file(scene, "none.mtl", false));
}

// Its coming under either name has to be noticed, or the warning would stay.
TEST(ImportFiles, AMissingFileWithEscapesIsListedUnderBothNames) {
  const TempFolder folder;
  const mesh::Scene scene =
      import_asset(folder.write("a.obj", std::string("mtllib my%20own.mtl\n") + kTriangle));
  EXPECT_THAT(scene.warnings, testing::ElementsAre("material file \"my%20own.mtl\" is missing"));
  EXPECT_TRUE(has_file(scene, "my%20own.mtl", false));
  EXPECT_TRUE(has_file(scene, "my own.mtl", false));
}

// To the system "a" is what stands before the NUL.
TEST(ImportFiles, ANameWithANulIsNoFile) {
  const TempFolder folder;
  folder.write("a", "newmtl red\nKd 1 0 0\n");
  const mesh::Scene scene = import_asset(folder.write("b.obj", std::string("mtllib a%00.mtl\n") + kTriangle));
  EXPECT_THAT(scene.warnings, testing::ElementsAre("material file \"a%00.mtl\" is missing"));
  EXPECT_TRUE(has_file(scene, "a%00.mtl", false));
  EXPECT_EQ(scene.files.size(), 3U) << "itself, b.mtl as a guess, and that name as it is written";
}

TEST(ImportFiles, MaterialsAndTexturesAreListed) {
  const TempFolder folder;
  folder.write("sub/a.mtl",
               "newmtl red\nKd 1 0.5 0\nmap_Kd there.png\nnewmtl gone\nKd 0 1 0\nmap_Kd gone.png\n");
  folder.write("there.png", "not really");
  const mesh::Scene scene = import_asset(folder.write(
      "a.obj", "mtllib sub/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl gone\nf 3 2 1\n"));
  EXPECT_TRUE(has_file(scene, "sub/a.mtl", true));
  EXPECT_TRUE(has_file(scene, "there.png", true));
  EXPECT_TRUE(has_file(scene, "gone.png", false));
  EXPECT_TRUE(mentions(scene.warnings, "texture \"gone.png\" is missing"));
  ASSERT_EQ(scene.meshes.size(), 2u);
  const mesh::Material& red = scene.materials.at(scene.meshes[0].material);
  EXPECT_EQ(red.name, "red");
  EXPECT_THAT(red.base_color.value(), testing::ElementsAre(1.0f, 0.5f, 0.0f, 1.0f));
  EXPECT_EQ(scene.textures.at(red.texture.value()).path, "there.png");
}

TEST(ImportFiles, ReferencesOutOfTheFolderAreNotOpened) {
  const TempFolder folder;
  folder.write("outside.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string body = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  const mesh::Scene scene = import_asset(folder.write("in/a.obj", "mtllib ../outside.mtl\n" + body));
  EXPECT_TRUE(mentions(scene.warnings, "\"../outside.mtl\" leads out of the asset's folder"));
  for (const mesh::Material& material : scene.materials)
    EXPECT_NE(material.base_color, (std::array<float, 4>{1, 0, 0, 1})) << "the file was read";
  for (const mesh::ReferencedFile& file : scene.files) EXPECT_EQ(file.path.find(".."), std::string::npos);
}

TEST(ImportFiles, LinksOutOfTheFolderAreNotFollowed) {
  const TempFolder store, folder;
  std::filesystem::create_symlink(store.write("outside.mtl", "newmtl red\nKd 1 0 0\n"),
                                  folder.path() / "a.mtl");
  const mesh::Scene scene =
      import_asset(folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"));
  for (const mesh::Material& material : scene.materials)
    EXPECT_NE(material.base_color, (std::array<float, 4>{1, 0, 0, 1})) << "the file was read";
}

TEST(ImportFiles, AWayOutAndBackInIsFine) {
  const TempFolder folder;
  folder.write("in/a.mtl", "newmtl red\nKd 1 0 0\n");
  const mesh::Scene scene = import_asset(
      folder.write("in/a.obj", "mtllib ../in/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"));
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(has_file(scene, "a.mtl", true));
}

}  // namespace
}  // namespace scene_analyzer::import
