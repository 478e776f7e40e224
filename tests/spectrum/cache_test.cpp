// Plans' binaries in the device's cache folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "spectrum/signals.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::spectrum {
namespace {

namespace fs = std::filesystem;

class SpectrumCacheTest : public test::GpuTest {
 protected:
  // Transforms on a device of its own that uses the folder.
  static std::vector<SpectrumTotals> use(const fs::path& folder) {
    gpu::DeviceOptions options = test::device_options();
    options.cache_folder = folder;
    gpu::Device cached(options);
    SpectrumBuilder builder(cached);
    auto totals = builder.transform(spans_of({random_samples(1000, 1), random_samples(20000, 2)}));
    EXPECT_THAT(cached.take_validation_messages(), testing::IsEmpty());
    return totals;
  }
  static std::map<std::string, std::string> plans_in(const fs::path& folder) {
    std::map<std::string, std::string> plans;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("fft-")) plans[name] = TemporaryFolder::read(entry.path());
    }
    return plans;
  }
};

TEST_F(SpectrumCacheTest, PlansAreWrittenOnceAndReadBack) {
  const TemporaryFolder folder;
  const std::vector<SpectrumTotals> first = use(folder.path());
  const auto plans = plans_in(folder.path());
  ASSERT_EQ(plans.size(), 2U);
  for (const auto& [name, contents] : plans) {
    EXPECT_THAT(name, testing::MatchesRegex("fft-[0-9]+-[0-9a-f]{16}[.]bin"));
    EXPECT_GT(contents.size(), 1000U);
    fs::last_write_time(folder.path() / name,
                        fs::last_write_time(folder.path() / name) - std::chrono::hours(1));
  }
  const auto written = fs::last_write_time(folder.path() / plans.begin()->first);
  EXPECT_EQ(use(folder.path()), first);
  EXPECT_EQ(plans_in(folder.path()), plans);
  EXPECT_EQ(fs::last_write_time(folder.path() / plans.begin()->first), written);
}

TEST_F(SpectrumCacheTest, DamagedPlansAreMadeAnew) {
  const TemporaryFolder folder;
  const std::vector<SpectrumTotals> first = use(folder.path());
  const auto plans = plans_in(folder.path());
  ASSERT_FALSE(plans.empty());
  const std::string name = plans.begin()->first, sound = plans.begin()->second;
  std::string flipped = sound;
  flipped[sound.size() / 2] ^= 1;
  for (const std::string& damaged :
       {std::string(), std::string("x"), flipped, sound.substr(0, sound.size() - 4), sound + "more"}) {
    folder.write(name, damaged);
    EXPECT_EQ(use(folder.path()), first);
    EXPECT_EQ(plans_in(folder.path()), plans);
  }
}

TEST_F(SpectrumCacheTest, UnwritableFolderIsNoFailure) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a file", "not a folder");
  testing::internal::CaptureStdout();
  const std::vector<SpectrumTotals> totals = use(file);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("a file"));
  EXPECT_GT(totals[0].zero, 0);
}

}  // namespace
}  // namespace scene_analyzer::spectrum
