#include "analysis_file/sample.h"
#include "base/error.h"
#include "files/temporary_name.h"

namespace scene_analyzer::analysis_file {
namespace {

using std::chrono::hours;

class Prune : public FolderTest {
 protected:
  fs::path put(const std::string& name, std::size_t bytes, hours age) {
    const fs::path path = folder / name;
    fs::create_directories(path.parent_path());
    write_text(path, std::string(bytes, 'x'));
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path;
  }
  static void expect(const PruneResult& result, std::uint64_t removed, std::uint64_t removed_bytes,
                     std::uint64_t kept, std::uint64_t kept_bytes) {
    EXPECT_EQ(result.files_removed, removed);
    EXPECT_EQ(result.bytes_removed, removed_bytes);
    EXPECT_EQ(result.files_kept, kept);
    EXPECT_EQ(result.bytes_kept, kept_bytes);
  }
};

TEST_F(Prune, WithoutLimitsNothingGoes) {
  put("a.analysis", 10, hours(24 * 1000));
  expect(prune(folder, std::nullopt, std::nullopt), 0, 0, 1, 10);
}

TEST_F(Prune, ByAge) {
  const auto old = put("deep/er/old.analysis", 10, hours(49));
  const auto young = put("young.analysis", 20, hours(47));
  const auto future = put("future.analysis", 30, hours(-100));
  expect(prune(folder, 2.0, std::nullopt), 1, 10, 2, 50);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young) && fs::exists(future));
}

TEST_F(Prune, BySizeTheLeastRecentlyUsedGo) {
  const auto third = put("a.analysis", 100, hours(3));
  const auto first = put("b.analysis", 100, hours(1));
  const auto second = put("sub/c.analysis", 100, hours(2));
  const auto fourth = put("d.analysis", 1, hours(4));
  expect(prune(folder, std::nullopt, 200), 2, 101, 2, 200);
  EXPECT_TRUE(fs::exists(first) && fs::exists(second));
  EXPECT_FALSE(fs::exists(third) || fs::exists(fourth));
  expect(prune(folder, std::nullopt, 0), 2, 200, 0, 0);
}

TEST_F(Prune, AgeFirstThenSize) {
  put("old.analysis", 100, hours(72));
  put("a.analysis", 100, hours(2));
  put("b.analysis", 100, hours(1));
  expect(prune(folder, 2.0, 150), 2, 200, 1, 100);
  EXPECT_TRUE(fs::exists(folder / "b.analysis"));
}

TEST_F(Prune, AHitKeepsAFileFromGoing) {
  write_text(folder / "used.obj", "asset");
  auto analysis = full_analysis();
  analysis.files = fingerprint(folder / "used.obj", {});
  store(folder / "used.analysis", analysis);
  fs::last_write_time(folder / "used.analysis", fs::file_time_type::clock::now() - hours(100));
  put("unused.analysis", 10, hours(50));
  load_valid(folder / "used.analysis", folder / "used.obj", analysis.parameters);
  EXPECT_EQ(prune(folder, 1.0, std::nullopt).files_removed, 1u);
  EXPECT_TRUE(fs::exists(folder / "used.analysis"));
}

TEST_F(Prune, LeftoversOfInterruptedWritesGoAfterAnHour) {
  const auto old = put("sub/" + files::temporary_name(), 10, hours(2));
  const auto fresh = put("sub/" + files::temporary_name(), 10, hours(0));
  expect(prune(folder, std::nullopt, std::nullopt), 1, 10, 0, 0);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(fresh));
}

TEST_F(Prune, OtherFilesStay) {
  put("room.obj", 10, hours(9999));
  put("notes.analysis.txt", 10, hours(9999));
  put(".scene-analyzer-notes.tmp", 10, hours(9999));
  fs::create_directory(folder / "folder.analysis");
  expect(prune(folder, 0.0, 0), 0, 0, 0, 0);
  EXPECT_EQ(entries(folder), 4);
}

TEST_F(Prune, LinksAreNeitherFollowedNorRemoved) {
  const auto outside = put("outside/a.analysis", 10, hours(9999));
  const fs::path cache = folder / "cache";
  fs::create_directory(cache);
  fs::create_directory_symlink(folder / "outside", cache / "linked");
  fs::create_symlink(outside, cache / "b.analysis");
  expect(prune(cache, 0.0, 0), 0, 0, 0, 0);
  EXPECT_TRUE(fs::exists(outside));
  EXPECT_EQ(entries(cache), 2);
}

TEST_F(Prune, WhatCannotBeSearchedIsAnError) {
  EXPECT_THROW(prune(folder / "absent", 1.0, 1), InputError);
  write_text(folder / "file", "");
  EXPECT_THROW(prune(folder / "file", 1.0, 1), InputError);
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
