#include <filesystem>

#include "gpu/device.h"
#include "support/gpu_test.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"
// Generated:
#include "write_index.spv.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;

class PipelineCacheTest : public test::GpuTest {
 protected:
  // Opens a device on the folder, makes a kernel and closes it again.
  void use(const fs::path& folder) {
    gpu::DeviceOptions options = test::device_options();
    options.cache_folder = folder;
    gpu::Device cached(options);
    EXPECT_EQ(cached.make_kernel("write_index", write_index_spv).local_size(), 64u);
    EXPECT_THAT(cached.take_validation_messages(), testing::IsEmpty());
  }
  static std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    return files;
  }
  fs::path only_file(const fs::path& folder) {
    const auto files = files_of(folder);
    EXPECT_EQ(files.size(), 1u);
    return files.empty() ? fs::path() : files[0];
  }
};

TEST_F(PipelineCacheTest, IsWrittenOnceAndReadBack) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "made" / "when needed";
  use(folder);
  const fs::path file = only_file(folder);
  EXPECT_THAT(file.filename().string(),
              testing::MatchesRegex("pipelines-[0-9a-f]{8}-[0-9a-f]{8}-[0-9a-f]{32}[.]bin"));
  const std::string contents = TemporaryFolder::read(file);
  EXPECT_GT(contents.size(), 32u);  // Vulkan's header and the checksum at least

  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);

  const auto long_ago = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  use(folder);
  EXPECT_EQ(fs::last_write_time(only_file(folder)), long_ago);  // unchanged, so not written
  EXPECT_EQ(TemporaryFolder::read(file), contents);
}

TEST_F(PipelineCacheTest, DamagedFileIsReplaced) {
  const TemporaryFolder folder;
  use(folder.path());
  const fs::path file = only_file(folder.path());
  const std::string sound = TemporaryFolder::read(file);
  std::string flipped = sound;
  flipped[sound.size() / 2] ^= 1;
  for (const std::string& damaged :
       {std::string(), std::string("x"), flipped, sound.substr(0, sound.size() - 1), sound + "more"}) {
    folder.write(file.filename().string(), damaged);
    use(folder.path());
    EXPECT_EQ(TemporaryFolder::read(only_file(folder.path())), sound);
  }
}

TEST_F(PipelineCacheTest, UnwritableFolderIsNoFailure) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a file", "not a folder");
  testing::internal::CaptureStdout();
  use(file);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("a file"));  // a warning names it
  EXPECT_EQ(TemporaryFolder::read(file), "not a folder");
}

TEST_F(PipelineCacheTest, FileThatCannotBeReplacedIsNoFailureAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  use(folder.path());
  const fs::path file = only_file(folder.path());
  fs::remove(file);
  fs::create_directories(file / "in the way");
  testing::internal::CaptureStdout();
  use(folder.path());
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              testing::HasSubstr("writing the pipeline cache " + file.string() + ": Is a directory"));
  EXPECT_EQ(only_file(folder.path()), file);
}

TEST_F(PipelineCacheTest, FullDiskIsNoFailureAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path(), "4k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  const fs::path filler = folder.write("filler", std::string(4096, 'x'));
  testing::internal::CaptureStdout();
  use(folder.path());
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("No space left on device"));
  EXPECT_EQ(only_file(folder.path()), filler);
}

TEST_F(PipelineCacheTest, WithoutFolderNothingIsWritten) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  gpu::Device(test::device_options()).make_kernel("write_index", write_index_spv);
  fs::current_path(before);
  EXPECT_TRUE(files_of(folder.path()).empty());
}

}  // namespace
}  // namespace scene_analyzer
