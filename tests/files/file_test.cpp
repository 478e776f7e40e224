#include "files/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <thread>

#include "support/child_process.h"
#include "support/hooked_sync.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::files {
namespace {

namespace fs = std::filesystem;

// The errno of what `body` throws, 0 when it throws nothing.
template <typename Body>
int error_of(Body body) {
  try {
    body();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().category(), std::generic_category());
    return error.code().value();
  }
  return 0;
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(File, WritesAreReadBackInPieces) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a file";
  File written = File::create(path);
  written.write("first ");
  written.write("");
  written.write("second");
  EXPECT_EQ(written.size(), 12U);
  written.close();
  File file = File::open_regular(path);
  std::array<char, 8> piece{};
  EXPECT_EQ(file.read(piece), 8U);
  EXPECT_EQ(std::string(piece.data(), 8), "first se");
  EXPECT_EQ(file.read(piece), 4U);  // as far as the file goes
  EXPECT_EQ(std::string(piece.data(), 4), "cond");
  EXPECT_EQ(file.read(piece), 0U);
}

TEST(File, CreateTakesNoNameThatIsTaken) {
  const TemporaryFolder folder;
  const fs::path taken = folder.write("taken", "old");
  fs::create_symlink("nowhere", folder.path() / "link");
  EXPECT_EQ(error_of([&] { File::create(taken); }), EEXIST);
  EXPECT_EQ(error_of([&] { File::create(folder.path() / "link"); }), EEXIST);
  EXPECT_EQ(TemporaryFolder::read(taken), "old");
  EXPECT_FALSE(fs::exists(folder.path() / "nowhere"));
}

TEST(File, ModesAreUnderTheUmaskUnlessSet) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  File::create(folder.path() / "usual");
  File::create(folder.path() / "own", 0604);
  File::create(folder.path() / "set").set_mode(0666);
  ::umask(before);
  EXPECT_EQ(mode_of(folder.path() / "usual"), 0640U);
  EXPECT_EQ(mode_of(folder.path() / "own"), 0600U);
  EXPECT_EQ(mode_of(folder.path() / "set"), 0666U);
}

// A pipe would block, a device has no end: neither may be opened as a file to read.
TEST(File, OnlyRegularFilesAreOpenedToBeRead) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { File::open_regular(pipe); }), EINVAL);
  EXPECT_EQ(error_of([] { File::open_regular("/dev/zero"); }), EINVAL);
  EXPECT_EQ(error_of([&] { File::open_regular(folder.path()); }), EISDIR);
  EXPECT_EQ(error_of([&] { File::open_regular(folder.path() / "absent"); }), ENOENT);
}

TEST(File, PipesAndDevicesAreWrittenInPlace) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string sent(300000, 'x');  // more than a pipe holds: written in pieces
  std::string received;
  std::thread reader([&] { received = TemporaryFolder::read(pipe); });
  File file = File::open_for_writing(pipe);
  file.write(sent);
  file.close();
  reader.join();
  EXPECT_EQ(received, sent);
  EXPECT_EQ(error_of([] { File::open_for_writing("/dev/full").write("x"); }), ENOSPC);
  EXPECT_EQ(error_of([&] { File::open_for_writing(folder.path() / "absent"); }), ENOENT);
}

TEST(File, WriteAllLeavesTheDescriptorToItsOwner) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  write_all(ends[1], "abc");
  EXPECT_EQ(::close(ends[1]), 0);
  std::array<char, 4> received{};
  EXPECT_EQ(::read(ends[0], received.data(), received.size()), 3);
  EXPECT_EQ(::close(ends[0]), 0);
  EXPECT_EQ(error_of([&] { write_all(-1, "abc"); }), EBADF);
}

TEST(File, InterruptedSyncsAreRepeatedOthersAreErrors) {
  const TemporaryFolder folder;
  File file = File::create(folder.path() / "a file");
  int calls = 0;
  {
    const HookedSync hook([&](bool) { return ++calls < 3 ? EINTR : 0; });
    file.sync();
  }
  EXPECT_EQ(calls, 3);
  const HookedSync hook([](bool) { return EIO; });
  EXPECT_EQ(error_of([&] { file.sync(); }), EIO);
}

TEST(SyncFolder, FoldersThatCannotBeSyncedAreAcceptedFailuresAreNot) {
  const TemporaryFolder folder;
  for (const int accepted : {0, EINVAL, ENOTSUP, EINTR}) {
    const HookedSync hook([=](bool) { return accepted; });
    EXPECT_EQ(error_of([&] { sync_folder(folder.path()); }), 0) << accepted;
  }
  const HookedSync hook([](bool) { return EIO; });
  EXPECT_EQ(error_of([&] { sync_folder(folder.path()); }), EIO);
  EXPECT_EQ(error_of([&] { sync_folder(folder.path() / "absent"); }), ENOENT);
}

TEST(SyncFolder, NoNameIsTheWorkingFolder) {
  int folders = 0;
  const HookedSync hook([&](bool of_folder) { return folders += of_folder ? 1 : 0, 0; });
  sync_folder("");
  EXPECT_EQ(folders, 1);
}

// Root reads everything and has to become someone else first.
TEST(SyncFolder, AFolderThatMayBeWrittenButNotReadIsAccepted) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_write | fs::perms::owner_exec | fs::perms::others_write |
                                     fs::perms::others_exec);
  const int status = in_child([&] {
    if (::geteuid() == 0 && ::setuid(65534) != 0) return 2;
    return error_of([&] { sync_folder(folder.path()); });
  });
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(status, 0);
}

TEST(Describe, SaysWhatIsNoFileInWords) {
  EXPECT_EQ(describe(std::make_error_code(std::errc::is_a_directory)), "it is a folder");
  EXPECT_EQ(describe(std::make_error_code(std::errc::invalid_argument)), "it is not a regular file");
  EXPECT_EQ(describe(std::make_error_code(std::errc::permission_denied)), "Permission denied");
}

}  // namespace
}  // namespace scene_analyzer::files
