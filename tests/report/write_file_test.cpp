#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "report/fixture.h"
#include "support/hooked_sync.h"
#include "support/small_disk.h"

namespace scene_analyzer::report {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const fs::path& path) {
  try {
    write_file(path, "x");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFile, WritesAndReplacesWhole) {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "report.json";
  write_file(file, std::string(3'000'000, 'a'));
  EXPECT_EQ(contents_of(file), std::string(3'000'000, 'a'));
  write_file(file, "short\n");
  EXPECT_EQ(contents_of(file), "short\n");
  EXPECT_EQ(files_in(folder.path), 1u);  // no temporary left
}

TEST(WriteFile, RespectsUmaskAndKeepsTheModeOfAnExistingFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "report.json";
  const mode_t before = ::umask(022);
  write_file(file, "a");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
  ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
  write_file(file, "b");
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(WriteFile, ReplacesTheTargetOfASymbolicLink) {
  const TemporaryFolder folder;
  write_file(folder.path / "real.json", "a");
  fs::create_symlink("real.json", folder.path / "link.json");
  write_file(folder.path / "link.json", "b");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link.json"));
  EXPECT_EQ(contents_of(folder.path / "real.json"), "b");
}

TEST(WriteFile, AcceptsTheLongestFileName) {
  const TemporaryFolder folder;
  const fs::path file = folder.path / std::string(255, 'n');
  write_file(file, "a");
  EXPECT_EQ(contents_of(file), "a");
}

TEST(WriteFile, WritesIntoPipesAndDevicesInsteadOfReplacingThem) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = contents_of(pipe); });
  write_file(pipe, "through the pipe");
  reader.join();
  EXPECT_EQ(read, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(pipe));
  write_file("/dev/null", "nothing");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteFile, NamesFileAndReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.path / "missing" / "report.json"),
              AllOf(HasSubstr("missing/report.json"), HasSubstr("No such file or directory")));
  EXPECT_THAT(message_of(folder.path), HasSubstr("Is a directory"));
  write_file(folder.path / "file", "");
  EXPECT_THAT(message_of(folder.path / "file" / "report.json"), HasSubstr("Not a directory"));
  EXPECT_THAT(message_of("/dev/full"), HasSubstr("No space left on device"));
}

TEST(WriteFile, OldReportStaysWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  const fs::path file = folder.path / "report.json";
  write_file(file, "old");
  try {
    write_file(file, std::string(200000, 'x'));
    ADD_FAILURE() << "the disk is not full";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "cannot write " + file.string() + ": No space left on device");
  }
  EXPECT_EQ(contents_of(file), "old");
  EXPECT_EQ(files_in(folder.path), 1u);
}

// The report is there, and whole: no reason to call the run a failure.
TEST(WriteFile, FolderThatCannotBeSyncedIsNoFailure) {
  const TemporaryFolder folder;
  const HookedSync hook([](bool of_folder) { return of_folder ? EIO : 0; });
  write_file(folder.path / "report.json", "a");
  EXPECT_EQ(contents_of(folder.path / "report.json"), "a");
}

TEST(WriteFile, DashIsStandardOutput) {
  ::testing::internal::CaptureStdout();
  std::printf("before ");
  write_file("-", "after\n");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "before after\n");
}

}  // namespace
}  // namespace scene_analyzer::report
