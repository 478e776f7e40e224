// Which assets below the service's folder are found, and that nothing else is.
#include "service/root_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "base/error.h"
#include "service/refused.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// home/root is served; home/secret and home/secret.obj lie beside it.
class RootFolderTest : public testing::Test {
 protected:
  RootFolderTest() {
    fs::create_directories(root_ / "sub/deep");
    fs::create_directories(home_ / "secret");
    for (const char* file :
         {"root/a.obj", "root/sub/b.obj", "root/sub/deep/c.obj", "secret.obj", "secret/inner.obj"})
      folder_.write(file, file);
  }
  void link(const fs::path& target, const fs::path& name) { fs::create_symlink(target, root_ / name); }
  std::string refusal(const std::string& name) {
    return refused([&] { RootFolder(root_).find(name); });
  }
  // What is read there.
  std::string found(const std::string& name) {
    return TemporaryFolder::read(RootFolder(root_).find(name).file);
  }

  TemporaryFolder folder_;
  const fs::path home_ = folder_.path();
  const fs::path root_ = home_ / "root";
};

TEST_F(RootFolderTest, FindsWhatLiesBelowIt) {
  EXPECT_EQ(found("a.obj"), "root/a.obj");
  EXPECT_EQ(found("sub/b.obj"), "root/sub/b.obj");
  EXPECT_EQ(found("./sub//deep/./c.obj"), "root/sub/deep/c.obj");
  EXPECT_EQ(found("sub/deep/../../a.obj"), "root/a.obj") << "the way does not lead out";
  const mesh::AssetSource asset = RootFolder(root_).find("sub/./deep/c.obj");
  EXPECT_EQ(asset.name, "sub/deep/c.obj") << "clients do not learn where the folder lies";
  EXPECT_EQ(asset.file, fs::canonical(root_ / "sub/deep/c.obj"));
  EXPECT_EQ(asset.file_names, nullptr);
}

TEST_F(RootFolderTest, LinksMayLeadAnywhereBelowIt) {
  link("sub/b.obj", "link.obj");
  link("sub", "way");
  link(root_ / "sub", "absolute");
  link("../a.obj", "sub/up.obj");
  EXPECT_EQ(found("link.obj"), "root/sub/b.obj");
  EXPECT_EQ(found("way/deep/c.obj"), "root/sub/deep/c.obj");
  EXPECT_EQ(found("absolute/b.obj"), "root/sub/b.obj");
  EXPECT_EQ(found("way/up.obj"), "root/a.obj");
  EXPECT_EQ(RootFolder(root_).find("way/up.obj").name, "a.obj");
}

TEST_F(RootFolderTest, TheFolderMayBeALinkItself) {
  fs::create_directory_symlink(root_, home_ / "served");
  const RootFolder served(home_ / "served");
  EXPECT_EQ(served.find("a.obj").file, fs::canonical(root_ / "a.obj"));
  EXPECT_EQ(refused([&] { served.find("../secret.obj"); }).substr(0, 9), "not_found");
}

TEST_F(RootFolderTest, ARelativeFolderStaysTheSameOne) {
  const fs::path before = fs::current_path();
  fs::current_path(home_);
  const RootFolder root("root");
  fs::current_path(before);
  EXPECT_EQ(TemporaryFolder::read(root.find("a.obj").file), "root/a.obj");
}

TEST_F(RootFolderTest, RefusesEverythingElseInTheSameWords) {
  link("../secret.obj", "out.obj");
  link("../secret", "away");
  link(home_ / "secret.obj", "absolute.obj");
  link("nowhere.obj", "dangling.obj");
  link("circle.obj", "circle.obj");
  ASSERT_EQ(::mkfifo((root_ / "pipe.obj").c_str(), 0600), 0);
  const auto expect_missing = [&](const std::string& name) {
    const std::string shown = name.substr(0, name.find('\0'));
    EXPECT_EQ(refusal(name), "not_found: '" + shown + "' is no asset below the service's --root");
  };
  for (const char* name : {"none.obj",
                           "none/a.obj",
                           "a.obj/",
                           "a.obj/b",
                           "a.obj/../a.obj",
                           "",
                           ".",
                           "./",
                           "sub",
                           "sub/..",
                           "..",
                           "../root",
                           "../secret.obj",
                           "sub/../../secret.obj",
                           "/",
                           "//etc/passwd",
                           "out.obj",
                           "absolute.obj",
                           "away",
                           "away/inner.obj",
                           "dangling.obj",
                           "circle.obj",
                           "pipe.obj",
                           "A.OBJ",
                           "sub\\b.obj",
                           "a%2eobj",
                           "file://a.obj"})
    expect_missing(name);
  expect_missing((root_ / "a.obj").string());
  expect_missing((home_ / "secret.obj").string());
  expect_missing(std::string("a.obj\0", 6));
  expect_missing(std::string("a.obj\0.obj", 10));
  expect_missing(std::string(1, '\0'));
  expect_missing(std::string(5000, 'x'));
}

// Nobody learns what lies beside the folder by a way that leads there and back.
TEST_F(RootFolderTest, AWayOutAndBackInIsRefusedWhetherOrNotItExists) {
  link("../secret", "away");
  for (const std::string name : {"../root/a.obj", "../secret/../root/a.obj", "../none/../root/a.obj",
                                 "sub/../../root/a.obj", "away/../root/a.obj", "../secret.obj/../root/a.obj"})
    EXPECT_EQ(refusal(name), "not_found: '" + name + "' is no asset below the service's --root");
}

TEST_F(RootFolderTest, WhatIsNoFolderIsRefusedAtTheStart) {
  const auto refusal_of = [](const fs::path& folder) -> std::string {
    try {
      const RootFolder root(folder);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal_of(home_ / "none"), AllOf(HasSubstr("--root"), HasSubstr("No such file")));
  EXPECT_THAT(refusal_of(root_ / "a.obj"), AllOf(HasSubstr("a.obj"), HasSubstr("no folder")));
}

}  // namespace
}  // namespace scene_analyzer::service
