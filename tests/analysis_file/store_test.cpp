#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <thread>

#include "analysis_file/sample.h"
#include "base/error.h"
#include "support/child_process.h"
#include "support/hooked_sync.h"
#include "support/small_disk.h"

namespace scene_analyzer::analysis_file {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Store = FolderTest;

// The message of a store that has to fail.
std::string failure(const fs::path& file, const analysis::AssetAnalysis& analysis) {
  try {
    store(file, analysis);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Store, MissingFoldersAreCreated) {
  store(folder / "a/b/c/x.analysis", full_analysis());
  EXPECT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(load(folder / "a/b/c/x.analysis")));
}

// Whether it fails for this analysis, and others can be stored.
bool fails_alone(const fs::path& file, const analysis::AssetAnalysis& analysis) {
  try {
    store(file, analysis);
  } catch (const CannotStore& error) {
    return error.is_the_assets();
  }
  return false;
}

TEST_F(Store, UnwritablePlacesAreNamedWithTheReason) {
  write_text(folder / "file", "");
  const fs::path below_file = folder / "file" / "x.analysis";
  EXPECT_THAT(failure(below_file, full_analysis()),
              AllOf(HasSubstr(below_file.string()), HasSubstr("Not a directory")));
  EXPECT_THAT(failure("/proc/self/x.analysis", full_analysis()), HasSubstr("/proc/self/x.analysis"));
  EXPECT_FALSE(fails_alone("/proc/self/x.analysis", full_analysis()));
  const fs::path long_name = folder / (std::string(300, 'x') + ".analysis");
  EXPECT_THAT(failure(long_name, full_analysis()), HasSubstr("File name too long"));
  EXPECT_TRUE(fails_alone(long_name, full_analysis()));
  EXPECT_EQ(entries(folder), 1);
}

// A folder without write permission stops everyone but root, who has to become someone else first.
TEST_F(Store, FolderWithoutWritePermission) {
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                              fs::perms::others_exec);
  const int status = in_child([&] {
    if (::geteuid() == 0 && ::setuid(65534) != 0) return 2;
    return failure(folder / "x.analysis", full_analysis()).find("Permission denied") != std::string::npos ? 0
                                                                                                          : 1;
  });
  fs::permissions(folder, fs::perms::owner_all);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(entries(folder), 0);
}

TEST_F(Store, TargetThatIsAFolderLeavesNothingBehind) {
  fs::create_directories(folder / "x.analysis/kept");
  EXPECT_THAT(failure(folder / "x.analysis", full_analysis()), HasSubstr("directory"));
  EXPECT_EQ(entries(folder), 1);
}

TEST_F(Store, FullDisk) {
  const SmallDisk disk(folder, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  auto large = full_analysis();
  large.warnings.assign(1, std::string(200000, 'w'));
  EXPECT_THAT(failure(folder / "x.analysis", large), HasSubstr("No space left on device"));
  EXPECT_FALSE(fails_alone(folder / "x.analysis", large));
  EXPECT_EQ(entries(folder), 0);
  store(folder / "small.analysis", full_analysis());
}

// An error has to mean that nothing is stored, also after the next power failure.
TEST_F(Store, FolderThatCannotBeSynced) {
  const HookedSync hook([](bool of_folder) { return of_folder ? EIO : 0; });
  EXPECT_THAT(failure(folder / "x.analysis", full_analysis()), HasSubstr("Input/output error"));
  EXPECT_EQ(entries(folder), 0);
}

TEST_F(Store, KilledAtAnyMomentLeavesAWholeFileOrNone) {
  auto large = full_analysis();
  replace_geometries(large, 5000);
  const auto start = std::chrono::steady_clock::now();
  store(folder / "first.analysis", large);
  const std::chrono::duration<double> one_store = std::chrono::steady_clock::now() - start;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> stores_until_kill(0, 4);
  int present = 0;
  for (int round = 0; round < 30; ++round) {
    const fs::path file = folder / (std::to_string(round) + ".analysis");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (std::uint32_t i = 0;; ++i) {
        large.geometries[0].mesh = i;
        store(file, large);
      }
    }
    std::this_thread::sleep_for(one_store * stores_until_kill(random));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child has to be killed, not to end";
    const auto loaded = load(file);
    const auto* unusable = std::get_if<Unusable>(&loaded);
    if (unusable == nullptr) ++present;
    EXPECT_TRUE(unusable == nullptr || unusable->absent) << unusable->reason;
  }
  std::printf("whole after %d of 30 kills, absent after the others\n", present);
  EXPECT_GT(present, 0) << "no kill came after a first store: the times are wrong";
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
