// Assets whose files lie under numbers: what their references find, and that nothing else changes.
#include "import/file_names.h"

#include <gmock/gmock.h>

#include <system_error>

#include "import/asset_files.h"
#include "import/gltf_builder.h"
#include "import/image_builder.h"
#include "import/same_scene.h"
#include "import/temp_folder.h"
#include "support/numbered_files.h"

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;
using Kind = Reference::Kind;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// AssetFiles in a folder with files under the numbers of `names`, as the worker sees it.
class NamedFilesTest : public testing::Test {
 protected:
  NamedFilesTest() { fs::current_path(folder_.path()); }
  ~NamedFilesTest() override { fs::current_path(before_); }

  AssetFiles files(const mesh::FileNames& names) const {
    NamedContents contents;
    for (const std::string& name : names) contents.emplace_back(name, name);
    const mesh::AssetSource asset = write_numbered(folder_, contents);
    write_file_names(folder_.path(), names);
    return {asset.file.filename().string(), names};
  }

  const fs::path before_ = fs::current_path();
  TempFolder folder_;
};

std::vector<std::string> recorded(const AssetFiles& files) {
  std::vector<std::string> all;
  for (const mesh::ReferencedFile& file : files.files()) all.push_back((file.found ? "" : "no ") + file.path);
  return all;
}

TEST_F(NamedFilesTest, NamesAreFoundHoweverTheyAreWritten) {
  AssetFiles named = files({"room.gltf", "a.bin", "sub/b.png"});
  EXPECT_EQ(named.asset_name(), "room.gltf");
  EXPECT_EQ(named.asset_path(), "0.gltf");
  for (const auto& [text, path, name] : {std::tuple{"a.bin", "1", "a.bin"},
                                         {"./a.bin", "1", "a.bin"},
                                         {"x/../a.bin", "1", "a.bin"},
                                         {"sub/b.png", "2", "sub/b.png"},
                                         {"sub\\b.png", "2", "sub/b.png"},
                                         {"sub//b.png", "2", "sub/b.png"},
                                         {"room.gltf", "./0.gltf", "room.gltf"}}) {
    const AssetFiles::Found found = named.find(text);
    EXPECT_EQ(found.kind, Kind::kInside) << text;
    EXPECT_EQ(found.path, path) << text;
    EXPECT_EQ(found.name, name) << text;
  }
  EXPECT_THAT(recorded(named), ElementsAre("room.gltf", "a.bin", "sub/b.png"));
  EXPECT_THAT(named.refused(), IsEmpty());
}

TEST_F(NamedFilesTest, WhatLeadsOutIsRefused) {
  AssetFiles named = files({"room.gltf", "a.bin", "../a.bin", "etc/passwd"});
  const std::vector<std::string> out = {"../a.bin",
                                        "..",
                                        "sub/../../a.bin",
                                        "..\\a.bin",
                                        "/1",
                                        "/etc/passwd",
                                        "C:\\a.bin",
                                        "c:a.bin",
                                        "%2e%2e/x",
                                        "%2Fetc/passwd",
                                        "..%2fa.bin",
                                        "\\\\server\\share",
                                        "/asset/a.bin",
                                        (folder_.path() / "1").string()};
  for (const std::string& text : out) {
    const AssetFiles::Found found = named.find(text);
    EXPECT_EQ(found.kind, Kind::kOutside) << text;
    EXPECT_EQ(found.path, "") << text;
  }
  EXPECT_EQ(named.find("http://host/a.bin").kind, Kind::kUrl);
  EXPECT_EQ(named.refused().size(), out.size() + 1);
  EXPECT_THAT(recorded(named), ElementsAre("room.gltf")) << "nothing of them counts as asked for";
}

TEST_F(NamedFilesTest, NamesOnTheDiskAreNoNames) {
  AssetFiles named = files({"room.gltf", "a.bin"});
  folder_.write("b.bin", "not of the asset");
  for (const char* text : {"0.gltf", "1", "./1", "names", "b.bin", "A.bin"}) {
    EXPECT_EQ(named.find(text).kind, Kind::kInside) << text;
    EXPECT_EQ(named.find(text).path, "") << text;
  }
  EXPECT_THAT(recorded(named),
              ElementsAre("room.gltf", "no 0.gltf", "no 1", "no names", "no b.bin", "no A.bin"));
}

TEST_F(NamedFilesTest, EscapesAreDecodedWhereTheNameItselfIsNotThere) {
  AssetFiles named = files({"room.gltf", "wood grain.png", "a%20b.png", "a b.png", "100%.png"});
  EXPECT_EQ(named.find("wood%20grain.png").name, "wood grain.png");
  EXPECT_EQ(named.find("wood%20grain.png").path, "1");
  EXPECT_EQ(named.find("wood grain.png").path, "1");
  EXPECT_EQ(named.find("a%20b.png").path, "2");
  EXPECT_EQ(named.find("a b.png").path, "3");
  EXPECT_EQ(named.find("100%.png").path, "4");
  EXPECT_EQ(named.find("100%25.png").path, "4");
  EXPECT_EQ(named.find("wood%2520grain.png").path, "") << "once only";
  EXPECT_EQ(named.find("gone%20.mtl").path, "");
  EXPECT_THAT(recorded(named),
              ElementsAre("room.gltf", "wood grain.png", "a%20b.png", "a b.png", "100%.png",
                          "no wood%2520grain.png", "no wood%20grain.png", "no gone%20.mtl", "no gone .mtl"))
      << "a missing one under each name that it would be found by";
  EXPECT_THAT(named.missing_with_extension(".mtl"), ElementsAre("gone%20.mtl"));
}

TEST_F(NamedFilesTest, NoFileIsCalledAsANameWithANul) {
  AssetFiles named = files({"room.gltf", "a"});
  EXPECT_EQ(named.find("a%00.png").path, "");
  EXPECT_EQ(named.find(std::string_view("a\0b", 3)).path, "");
  EXPECT_THAT(recorded(named), ElementsAre("room.gltf", "no a%00.png"));
}

TEST_F(NamedFilesTest, GuessesCountWhereThereIsSuchAFile) {
  AssetFiles named = files({"room.obj", "room.mtl"});
  EXPECT_EQ(named.find_guess("0.mtl").path, "");
  EXPECT_EQ(named.find_guess("../room.mtl").path, "");
  EXPECT_THAT(recorded(named), ElementsAre("room.obj"));
  EXPECT_THAT(named.refused(), IsEmpty());
  EXPECT_EQ(named.find_guess("room.mtl").path, "1");
  EXPECT_THAT(recorded(named), ElementsAre("room.obj", "room.mtl"));
}

TEST_F(NamedFilesTest, WhatIsNoFileAnyMoreIsMissing) {
  AssetFiles named = files({"room.obj", "a.mtl", "b.mtl"});
  fs::remove(folder_.path() / "1");
  fs::remove(folder_.path() / "2");
  fs::create_directory(folder_.path() / "2");
  for (const char* name : {"a.mtl", "b.mtl"}) EXPECT_EQ(named.find(name).path, "") << name;
  EXPECT_THAT(named.missing_with_extension(".mtl"), ElementsAre("a.mtl", "b.mtl"));
}

TEST(FileNames, AreReadAsTheyWereWritten) {
  for (const mesh::FileNames& names :
       {mesh::FileNames{"a.obj"},
        {"a.obj", "sub/b c.png", "line\nfeed", "\xff\xfe", std::string(1024, 'x')},
        mesh::FileNames(10000, "a name")}) {
    const TempFolder folder;
    write_file_names(folder.path(), names);
    EXPECT_EQ(read_file_names(folder.path()), names);
    EXPECT_THROW(write_file_names(folder.path(), names), std::system_error) << "there is one already";
  }
}

TEST(FileNames, DamagedOnesAreRefused) {
  const TempFolder folder;
  const std::string whole("room.obj\0a.mtl\0", 15);
  EXPECT_EQ(read_file_names(folder.write(kFileNames, whole).parent_path()).size(), 2u);
  for (const std::string& bytes :
       {std::string(), std::string("room.obj"), whole.substr(0, 12), whole.substr(0, 14), whole + '\0',
        '\0' + whole, std::string("a\0\0b\0", 5)}) {
    folder.write(kFileNames, bytes);
    EXPECT_THROW(read_file_names(folder.path()), InputError) << testing::PrintToString(bytes);
  }
}

TEST(FileNames, MissingOnesAreSaidToBe) {
  const TempFolder folder;
  fs::create_directory(folder.path() / kFileNames);
  for (const fs::path& without : {folder.path() / "none", folder.path()}) {
    try {
      read_file_names(without);
      FAIL() << without;
    } catch (const std::system_error& error) {
      EXPECT_THAT(error.what(), StartsWith("the names of the asset's files cannot be read: "));
    }
  }
}

}  // namespace
}  // namespace scene_analyzer::import
