// The room that all uploads share: privacy, quota, what killed services have left.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "base/error.h"
#include "service/refused.h"
#include "service/sent_files.h"
#include "support/child_process.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

mode_t mode_of(const fs::path& path) {
  struct stat state {};
  EXPECT_EQ(::lstat(path.c_str(), &state), 0) << path;
  return state.st_mode & 07777;
}

class UploadSpaceTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
  UploadSpace space_{folder_.path(), kPlenty};
};

TEST_F(UploadSpaceTest, EverythingIsPrivateWhateverTheMask) {
  const mode_t mask = ::umask(0);
  {
    const UploadSpace space(folder_.path(), kPlenty);
    EXPECT_EQ(mode_of(space.folder()), 0700U);
  }
  Upload upload(space_, kPlenty);
  send(upload, "a.obj", "1");
  send(upload, "b", "2");
  upload.finish();
  ::umask(mask);
  EXPECT_EQ(mode_of(only_upload(space_)), 0700U);
  for (const char* file : {"0.obj", "1", "names"})
    EXPECT_EQ(mode_of(only_upload(space_) / file), 0600U) << file;
}

TEST_F(UploadSpaceTest, AllUploadsShareAQuotaThatIsGivenBack) {
  UploadSpace space(folder_.path(), 64 << 10);
  const std::string bytes(40 << 10, 'x');
  auto first = std::make_unique<Upload>(space, kPlenty);
  send(*first, "a.obj", bytes);
  EXPECT_EQ(space.used_bytes(), bytes.size());
  std::optional<std::chrono::milliseconds> hint;
  {
    Upload second(space, kPlenty);
    second.begin_file("a.obj", bytes.size());
    try {
      second.add(bytes);
      FAIL() << "there is no room for it";
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.reason(), Reason::kBusy);
      EXPECT_THAT(refusal.what(), HasSubstr("--upload-space"));
      hint = refusal.retry_after();
    }
  }
  ASSERT_TRUE(hint);
  EXPECT_GT(hint->count(), 0);
  EXPECT_EQ(space.used_bytes(), bytes.size()) << "the second has left nothing";
  first.reset();
  EXPECT_EQ(space.used_bytes(), 0U);
  Upload third(space, kPlenty);
  EXPECT_EQ(refused([&] { send(third, "a.obj", bytes); }), "");
}

TEST_F(UploadSpaceTest, SmallFilesUseUpTheQuotaToo) {
  UploadSpace space(folder_.path(), 4 * 4096);
  Upload upload(space, kPlenty);
  for (const char* name : {"a.obj", "1", "2", "3"}) upload.begin_file(name, 0);
  EXPECT_EQ(space.used_bytes(), 4U * 4096U);
  EXPECT_THAT(refused([&] { upload.begin_file("4", 0); }), StartsWith("busy: "));
}

TEST_F(UploadSpaceTest, ManyAtTheSameTimeHaveFoldersOfTheirOwn) {
  constexpr int kThreads = 8, kRounds = 25;
  std::vector<int> right(kThreads);
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int round = 0; round < kRounds; ++round) {
          Upload upload(space_, kPlenty);
          const std::string bytes = std::to_string(thread) + " " + std::to_string(round);
          send(upload, "a.obj", bytes);
          right[static_cast<std::size_t>(thread)] += TemporaryFolder::read(upload.finish().file) == bytes;
        }
      });
  }
  EXPECT_THAT(right, testing::Each(kRounds));
  EXPECT_EQ(space_.used_bytes(), 0U);
}

TEST_F(UploadSpaceTest, AFolderThatCannotBeMadeIsNamed) {
  for (const fs::path& parent : {folder_.path() / "none", folder_.write("file", "")}) try {
      const UploadSpace space(parent, kPlenty);
      FAIL() << parent;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(parent.string()), HasSubstr("--upload-dir")));
    }
}

class LeftoversTest : public testing::Test {
 protected:
  // As a service leaves it that was killed.
  fs::path leftover(const std::string& name) {
    const fs::path folder = folder_.path() / name;
    fs::create_directories(folder / "17");
    for (const char* file : {"17/0.obj", "17/names"}) folder_.write(name + "/" + file, "");
    return folder;
  }

  TemporaryFolder folder_;
};

TEST_F(LeftoversTest, WhatAKilledServiceLeftIsRemoved) {
  const fs::path left = leftover("scene-analyzer-uploads-killed");
  const fs::path empty = folder_.path() / "scene-analyzer-uploads-early";
  fs::create_directory(empty);
  const UploadSpace space(folder_.path(), kPlenty);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(empty));
  EXPECT_TRUE(fs::exists(space.folder()));
}

TEST_F(LeftoversTest, WhatALivingServiceUsesStays) {
  const fs::path used = leftover("scene-analyzer-uploads-living");
  const int lock = ::open(used.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  { const UploadSpace space(folder_.path(), kPlenty); }
  EXPECT_TRUE(fs::exists(used / "17/0.obj"));
  ::close(lock);
  { const UploadSpace space(folder_.path(), kPlenty); }
  EXPECT_FALSE(fs::exists(used));
}

TEST_F(LeftoversTest, TwoServicesDoNotDisturbEachOther) {
  UploadSpace first(folder_.path(), kPlenty);
  Upload upload(first, kPlenty);
  send(upload, "a.obj", "bytes");
  const mesh::AssetSource asset = upload.finish();
  {
    const UploadSpace second(folder_.path(), kPlenty);
    EXPECT_NE(second.folder(), first.folder());
    EXPECT_TRUE(fs::exists(second.folder()));
  }
  EXPECT_EQ(TemporaryFolder::read(asset.file), "bytes");
}

TEST_F(LeftoversTest, OneThatIsReallyKilledIsTidiedUpAfter) {
  const int status = in_child([&] {
    UploadSpace space(folder_.path(), kPlenty);
    Upload upload(space, kPlenty);
    send(upload, "a.obj", "bytes");
    ::kill(::getpid(), SIGKILL);
    return 0;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
  { const UploadSpace space(folder_.path(), kPlenty); }
  EXPECT_THAT(everything_below(folder_.path()), IsEmpty());
}

TEST_F(LeftoversTest, NothingElseIsRemoved) {
  const TemporaryFolder elsewhere;
  const fs::path target = elsewhere.write("precious", "");
  const fs::path link = folder_.path() / "scene-analyzer-uploads-link";
  fs::create_directory_symlink(elsewhere.path(), link);
  const fs::path file = folder_.write("scene-analyzer-uploads-file", "");
  const fs::path other = leftover("scene-analyzer-upload");
  // A link in a folder that goes is no way to other files either.
  const fs::path goes = leftover("scene-analyzer-uploads-goes");
  fs::create_directory_symlink(elsewhere.path(), goes / "18");
  { const UploadSpace space(folder_.path(), kPlenty); }
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::exists(target));
  EXPECT_TRUE(fs::exists(file));
  EXPECT_TRUE(fs::exists(other / "17/0.obj"));
  EXPECT_FALSE(fs::exists(goes));
}

TEST_F(LeftoversTest, FoldersOfOtherUsersStay) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  const fs::path other = leftover("scene-analyzer-uploads-other");
  ASSERT_EQ(::chown(other.c_str(), 65534, 65534), 0);
  { const UploadSpace space(folder_.path(), kPlenty); }
  EXPECT_TRUE(fs::exists(other / "17/0.obj"));
}

TEST(UploadsOnASmallDisk, AFullDiskIsBusyUntilOthersHaveLeft) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path(), "256k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  UploadSpace space(folder.path(), kPlenty);
  const std::string most(180 << 10, 'x');
  auto first = std::make_unique<Upload>(space, kPlenty);
  send(*first, "a.obj", most);
  {
    Upload second(space, kPlenty);
    second.begin_file("a.obj", most.size());
    try {
      second.add(most);
      FAIL() << "there is no room for it";
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.reason(), Reason::kBusy);
      EXPECT_THAT(refusal.what(), HasSubstr("No space left on device"));
      EXPECT_TRUE(refusal.retry_after());
    }
  }
  first.reset();
  EXPECT_EQ(space.used_bytes(), 0U);
  Upload third(space, kPlenty);
  EXPECT_EQ(refused([&] {
              send(third, "a.obj", most);
              third.finish();
            }),
            "");
}

}  // namespace
}  // namespace scene_analyzer::service
