// Which files of folders and lists are the assets of a library.
#include "library/asset_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class AssetListTest : public testing::Test {
 protected:
  AssetListTest() {
    for (const char* file : {"b.glb", "a.OBJ", "notes.txt", "scene.xml", ".hidden.glb", "props/chair.fbx",
                             "props/old/chair.fbx", ".git/thing.obj"}) {
      fs::create_directories((folder_.path() / file).parent_path());
      folder_.write(file, std::string(file).substr(0, 3));
    }
  }

  std::vector<std::string> below(const AssetList& list) const {
    std::vector<std::string> names;
    for (const ListedAsset& asset : list.assets)
      names.push_back(fs::path(asset.path).lexically_relative(folder_.path()).string());
    return names;
  }
  std::vector<std::string> listed(const Filter& filter) {
    return below(list_assets({folder_.path().string()}, filter, input_));
  }

  TemporaryFolder folder_;
  std::istringstream input_;
};

TEST_F(AssetListTest, AFolderIsSearchedWithEverythingBelowIt) {
  EXPECT_THAT(listed({}), ElementsAre("a.OBJ", "b.glb", "props/chair.fbx", "props/old/chair.fbx"));
}

TEST_F(AssetListTest, GlobsSayWhatIsAnAsset) {
  EXPECT_THAT(listed({.include = {"props/*"}, .exclude = {"*/old/*"}}), ElementsAre("props/chair.fbx"));
  EXPECT_THAT(listed({.include = {"*.xml", "?.glb"}, .exclude = {}}), ElementsAre("b.glb", "scene.xml"));
  EXPECT_THAT(listed({.include = {}, .exclude = {"*"}}), IsEmpty());
}

TEST_F(AssetListTest, AnAssetIsListedOnceWithItsSize) {
  const std::string asset = (folder_.path() / "b.glb").string();
  const AssetList list = list_assets({asset, folder_.path().string(), asset}, {}, input_);
  EXPECT_EQ(list.assets.size(), 4U);
  EXPECT_EQ(list.repeated, 2U);
  EXPECT_EQ(list.assets[1], (ListedAsset{asset, 3}));
}

TEST_F(AssetListTest, AFileOfManyNamesIsOneAsset) {
  const fs::path root = folder_.path();
  fs::create_symlink("../b.glb", root / "props" / "a link.glb");
  fs::create_symlink(root / "props", root / "more props");
  input_.str((root / "props/../b.glb").string() + '\n' + (root / "more props/chair.fbx").string() + '\n' +
             (root / "./b.glb").string() + '\n');
  const AssetList list = list_assets({root.string(), "-"}, {}, input_);
  EXPECT_EQ(list.assets.size(), 4U);
  EXPECT_EQ(list.repeated, 4U);
  EXPECT_THAT(below(list), testing::Not(testing::Contains("props/a link.glb")))
      << "the file stands for its links";
}

TEST_F(AssetListTest, ALinkThatLeadsNowhereIsAnAssetThatWillFail) {
  fs::create_symlink("nowhere.obj", folder_.path() / "gone.obj");
  fs::create_symlink("round.obj", folder_.path() / "round.obj");
  fs::create_symlink("nowhere.txt", folder_.path() / "gone.txt");
  EXPECT_THAT(listed({}), ElementsAre("a.OBJ", "b.glb", "gone.obj", "props/chair.fbx", "props/old/chair.fbx",
                                      "round.obj"));
}

TEST_F(AssetListTest, ListsNameOneAssetPerLine) {
  input_.str("x.glb\r\n\nsome folder/y.obj");
  const fs::path list = folder_.write("list", "missing.glb\n");
  EXPECT_THAT(list_assets({"-", list.string()}, {}, input_).assets,
              ElementsAre(ListedAsset{"missing.glb", 0}, ListedAsset{"some folder/y.obj", 0},
                          ListedAsset{"x.glb", 0}));
}

TEST_F(AssetListTest, WhatIsNoLibraryIsRefused) {
  EXPECT_THROW(list_assets({"no/such/folder"}, {}, input_), UsageError);
  const fs::path binary = folder_.write("binary.dat", std::string("a\0b\n", 4));
  try {
    list_assets({binary.string()}, {}, input_);
    ADD_FAILURE() << "a binary file is no list";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("binary.dat: is no list of assets"));
  }
}

TEST_F(AssetListTest, LinksToFoldersAreNotFollowed) {
  fs::create_directory_symlink(folder_.path(), folder_.path() / "props" / "loop");
  fs::create_symlink(folder_.path() / "b.glb", folder_.path() / "props" / "link.glb");
  EXPECT_THAT(listed({.include = {"props/*"}, .exclude = {}}),
              ElementsAre("props/chair.fbx", "props/link.glb", "props/old/chair.fbx"));
}

TEST(Matches, GlobsOfWholePaths) {
  EXPECT_TRUE(matches("a/b/c.glb", "*.glb"));
  EXPECT_TRUE(matches("a/b/c.glb", "a/*"));
  EXPECT_TRUE(matches("lod2.glb", "lod[0-9].glb"));
  EXPECT_FALSE(matches("a/b/c.glb", "b/*"));
  EXPECT_FALSE(matches("a.glb", "A.glb"));
  EXPECT_TRUE(matches(std::string("na\xff") + "me", "na?me"));
}

}  // namespace
}  // namespace scene_analyzer::library
