// Files of the window: numbered, whole, and never at the cost of another one.
#include "viewer/ratings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>
#include <vector>

#include "base/error.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"
#include "viewer/rated_assets.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string message_of(const auto& write) {
  try {
    write();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RatingsFile, TheFirstFreeNumberIsTaken) {
  const TemporaryFolder folder;
  const auto next = [&] { return next_free_name(folder.path(), "a-", ".txt").filename().string(); };
  EXPECT_EQ(next(), "a-1.txt");
  folder.write("a-1.txt", "");
  folder.write("a-3.txt", "");
  folder.write("a-02.txt", "another name");
  EXPECT_EQ(next(), "a-2.txt") << "gaps are filled";
  folder.write("a-2.txt", "");
  EXPECT_EQ(next(), "a-4.txt");
  fs::create_directory(folder.path() / "a-4.txt");
  fs::create_symlink("nowhere", folder.path() / "a-5.txt");
  EXPECT_EQ(next(), "a-6.txt") << "folders and links to nowhere are names, too";
}

TEST(RatingsFile, WhatIsThereStaysAsItIs) {
  const TemporaryFolder folder;
  folder.write("a-1.txt", "old");
  fs::create_symlink("nowhere", folder.path() / "a-2.txt");
  EXPECT_EQ(write_numbered(folder.path(), "a-", ".txt", "new"), folder.path() / "a-3.txt");
  EXPECT_EQ(write_numbered(folder.path(), "a-", ".txt", "newer"), folder.path() / "a-4.txt");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "a-1.txt"), "old");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "a-3.txt"), "new");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "a-4.txt"), "newer");
  EXPECT_FALSE(fs::exists(folder.path() / "nowhere"));
  EXPECT_EQ(files_in(folder.path()), 4U) << "and nothing temporary";
}

TEST(RatingsFile, ANameThatIsTakenInTheMeantimeIsNotLost) {
  const TemporaryFolder folder;
  const fs::path free = next_free_name(folder.path(), "a-", ".txt");
  folder.write(free.filename(), "somebody else");
  EXPECT_EQ(write_numbered(folder.path(), "a-", ".txt", "mine"), folder.path() / "a-2.txt");
  EXPECT_EQ(TemporaryFolder::read(free), "somebody else");
}

TEST(RatingsFile, ManyAtTheSameTimeAllKeepTheirs) {
  const TemporaryFolder folder;
  constexpr int kThreads = 8, kEach = 10;
  std::vector<std::vector<std::pair<fs::path, std::string>>> written(kThreads);
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kEach; ++i) {
          const std::string text = std::string(5000, static_cast<char>('a' + thread)) + std::to_string(i);
          written[static_cast<std::size_t>(thread)].emplace_back(
              write_numbered(folder.path(), "a-", "", text), text);
        }
      });
  }
  std::set<fs::path> names;
  for (const auto& of_thread : written)
    for (const auto& [path, text] : of_thread) {
      EXPECT_TRUE(names.insert(path).second);
      EXPECT_EQ(TemporaryFolder::read(path), text);
    }
  EXPECT_EQ(files_in(folder.path()), std::size_t{kThreads} * kEach);
  EXPECT_TRUE(names.contains(folder.path() / "a-80"));
}

TEST(RatingsFile, NamesFileAndReason) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "");
  const auto write = [](const fs::path& where) {
    return message_of([&] { write_numbered(where, "a-", ".txt", "x"); });
  };
  EXPECT_THAT(write(folder.path() / "missing"),
              AllOf(HasSubstr("cannot write"), HasSubstr("missing/a-1.txt"), HasSubstr("No such file")));
  EXPECT_THAT(write(file), HasSubstr("Not a directory"));
  EXPECT_THAT(message_of([&] { next_free_name(folder.path(), std::string(5000, 'x'), ""); }),
              HasSubstr("File name too long"));
}

TEST(RatingsFile, AFullDiskLeavesNothing) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path(), "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  EXPECT_THAT(message_of([&] { write_numbered(folder.path(), "a-", "", std::string(200000, 'x')); }),
              HasSubstr("No space left"));
  EXPECT_EQ(files_in(folder.path()), 0U);
}

TEST(RatingsFile, RatingsAreTheReportsTable) {
  const TemporaryFolder folder;
  const std::vector<analysis::AssetAnalysis> assets = {test::rated_asset()};
  report::SceneReport report{.tool_version = "1",
                             .device = {},
                             .parameters = {},
                             .options = {},
                             .assets = assets,
                             .rating = ratings::rate(assets, {})};
  EXPECT_EQ(write_ratings(report, folder.path()), folder.path() / "scene-ratings-1.csv");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "scene-ratings-1.csv"), report::csv(report));
  EXPECT_EQ(write_ratings(report, folder.path()).filename(), "scene-ratings-2.csv");
}

}  // namespace
}  // namespace scene_analyzer::viewer
