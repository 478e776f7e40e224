#include "files/replace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include "files/temporary_name.h"
#include "support/child_process.h"
#include "support/hooked_sync.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::files {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

int equal_names = 0;  // how many of the next names are the same one

class Replace : public testing::Test {
 protected:
  // The errno of a replacement that has to fail, 0 when it does not.
  static int failure(const fs::path& target, std::string_view bytes, const ReplaceOptions& options = {}) {
    try {
      replace(target, bytes, options);
    } catch (const std::system_error& error) {
      return error.code().value();
    }
    return 0;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder.path()))
      found.push_back(entry.path().filename().string());
    return found;
  }

  void expect_only_the_old_file() const {
    EXPECT_EQ(TemporaryFolder::read(file), "old");
    EXPECT_THAT(names(), ElementsAre("file"));
  }

  mode_t mode() const {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0);
    return status.st_mode & 07777;
  }

  const TemporaryFolder folder;
  const fs::path file = folder.path() / "file";
};

TEST_F(Replace, MakesAndReplacesWholeFiles) {
  replace(file, std::string(3'000'000, 'a'));
  EXPECT_EQ(TemporaryFolder::read(file), std::string(3'000'000, 'a'));
  replace(file, "short");
  EXPECT_EQ(TemporaryFolder::read(file), "short");
  replace(file, "");
  EXPECT_EQ(TemporaryFolder::read(file), "");
  EXPECT_THAT(names(), ElementsAre("file"));
}

TEST_F(Replace, NamesWithoutFolderAreInTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  const int error = failure("file", "new");
  fs::current_path(before);
  EXPECT_EQ(error, 0);
  EXPECT_EQ(TemporaryFolder::read(file), "new");
}

TEST_F(Replace, TheLongestNameWorks) {
  const fs::path longest = folder.path() / std::string(255, 'n');
  replace(longest, "new");
  EXPECT_EQ(TemporaryFolder::read(longest), "new");
  EXPECT_EQ(failure(folder.path() / std::string(256, 'n'), "new"), ENAMETOOLONG);
  EXPECT_EQ(names().size(), 1U);
}

TEST_F(Replace, ALinkIsReplacedItself) {
  const fs::path other = folder.write("other", "untouched");
  fs::create_symlink(other, file);
  replace(file, "new");
  EXPECT_FALSE(fs::is_symlink(file));
  EXPECT_EQ(TemporaryFolder::read(other), "untouched");
}

TEST_F(Replace, ModesAreUnderTheUmaskUnlessExact) {
  const mode_t before = ::umask(027);
  replace(file, "");
  EXPECT_EQ(mode(), 0640U);
  replace(file, "", {.mode = 0604});
  EXPECT_EQ(mode(), 0600U);
  replace(file, "", {.mode = 0466, .exact_mode = true});
  EXPECT_EQ(mode(), 0466U);
  ::umask(before);
}

// --- Durability: the file before the rename, the folder after it. ---

TEST_F(Replace, TheFileIsSyncedBeforeTheRenameAndTheFolderAfterwards) {
  folder.write("file", "old");
  std::vector<std::string> seen;
  const HookedSync hook([&](bool of_folder) {
    seen.push_back((of_folder ? "folder: " : "file: ") + TemporaryFolder::read(file));
    return 0;
  });
  replace(file, "new");
  EXPECT_THAT(seen, ElementsAre("file: old", "folder: new"));
}

TEST_F(Replace, AFileThatCannotBeSyncedLeavesTheOldOne) {
  folder.write("file", "old");
  const HookedSync hook([](bool) { return EIO; });
  EXPECT_EQ(failure(file, "new"), EIO);
  expect_only_the_old_file();
}

TEST_F(Replace, AFolderThatCannotBeSyncedIsAFailureOnlyWhereAskedFor) {
  const HookedSync hook([](bool of_folder) { return of_folder ? EIO : 0; });
  EXPECT_EQ(failure(file, "new"), 0);
  EXPECT_EQ(TemporaryFolder::read(file), "new");
  EXPECT_EQ(failure(file, "newer", {.folder_sync = FolderSync::kRequired}), EIO);
  EXPECT_THAT(names(), IsEmpty());
}

// --- Failures leave nothing behind. ---

TEST_F(Replace, PlacesThatCannotBeWritten) {
  folder.write("file", "old");
  EXPECT_EQ(failure(file / "below", "new"), ENOTDIR);
  EXPECT_EQ(failure(folder.path() / "absent" / "file", "new"), ENOENT);
  expect_only_the_old_file();
}

TEST_F(Replace, AFolderIsNotReplaced) {
  fs::create_directories(file / "kept");
  EXPECT_EQ(failure(file, "new"), EISDIR);
  EXPECT_TRUE(fs::exists(file / "kept"));
  EXPECT_THAT(names(), ElementsAre("file"));
}

// The limit cuts a write short first and refuses the next one: the same two steps as a disk that fills up.
TEST_F(Replace, AWriteThatCannotFinishLeavesTheOldFile) {
  folder.write("file", "old");
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {100, 100};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
    return failure(file, std::string(200, 'x')) == EFBIG ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
  expect_only_the_old_file();
}

TEST_F(Replace, AFullDiskLeavesTheOldFile) {
  const SmallDisk disk(folder.path(), "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  folder.write("file", "old");
  EXPECT_EQ(failure(file, std::string(200000, 'x')), ENOSPC);
  expect_only_the_old_file();
  EXPECT_EQ(failure(file, std::string(30000, 'x')), 0);  // what was written in vain is free again
}

TEST_F(Replace, ANameThatIsTakenIsAnotherOnes) {
  equal_names = 1;
  const fs::path taken = folder.write(temporary_name(), "another's");
  equal_names = 3;
  replace(file, "new");
  EXPECT_EQ(TemporaryFolder::read(file), "new");
  equal_names = 1000;
  EXPECT_EQ(failure(file, "newer"), EEXIST);  // not for ever
  equal_names = 0;
  EXPECT_EQ(TemporaryFolder::read(file), "new");
  EXPECT_EQ(TemporaryFolder::read(taken), "another's");
}

// --- Others at the same time, and an end at any moment. ---

TEST_F(Replace, ManyWritersOfOneFile) {
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&] {
      for (int j = 0; j < 20; ++j) replace(file, std::string(10000, 'x'));
    });
  for (auto& writer : writers) writer.join();
  EXPECT_EQ(TemporaryFolder::read(file), std::string(10000, 'x'));
  EXPECT_THAT(names(), ElementsAre("file"));
}

TEST_F(Replace, KilledAtAnyMomentLeavesAWholeFile) {
  const std::vector<std::string> contents = {std::string(1'000'000, 'a'), std::string(1'500'000, 'b')};
  const auto start = std::chrono::steady_clock::now();
  replace(file, contents[0]);
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - start;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> times_until_kill(0, 4);
  int interrupted = 0;
  for (int round = 0; round < 30; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
      for (std::size_t i = 1;; ++i) replace(file, contents[i % 2]);
    // The child takes a moment to start, and then it never does anything else.
    std::this_thread::sleep_for(std::chrono::milliseconds(5) + once * times_until_kill(random));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child has to be killed, not to end";
    EXPECT_THAT(contents, testing::Contains(TemporaryFolder::read(file)));
    for (const std::string& name : names()) {
      if (name == "file") continue;
      EXPECT_TRUE(is_temporary_name(name)) << name;
      fs::remove(folder.path() / name);
      ++interrupted;
    }
  }
  std::printf("%d of 30 kills left a temporary file\n", interrupted);
  EXPECT_GT(interrupted, 0) << "no kill came within a replacement: the times are wrong";
}

}  // namespace
}  // namespace scene_analyzer::files

// Takes the place of the C library's for the whole program: where names come from.
extern "C" int getentropy(void* buffer, size_t length) {
  if (scene_analyzer::files::equal_names > 0) {
    --scene_analyzer::files::equal_names;
    std::memset(buffer, 0x5a, length);
    return 0;
  }
  return ::syscall(SYS_getrandom, buffer, length, 0) == static_cast<long>(length) ? 0 : -1;
}
