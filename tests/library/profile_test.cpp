// Assets through the pipeline into a journal: bad ones, lost devices, what is unchanged.
#include "library/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "gpu/error.h"
#include "library/import_pool.h"
#include "library/output_folder.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using analysis::Metric;
using testing::AllOf;
using testing::HasSubstr;

gpu::Device& shared_device() {
  static gpu::Device device;
  return device;
}

std::string triangle(int size) {
  return "v 0 0 0\nv " + std::to_string(size) + " 0 0\nv 0 1 0\no triangle\nf 1 2 3\n";
}

class ProfileTest : public testing::Test {
 protected:
  ProfileTest() {
    options_.folder = folder_.path() / "out";
    options_.jobs = 3;
    options_.pipeline.metrics.reset(index_of(Metric::kRenderingTime));
    options_.pipeline.cache_folder = analyses_folder(options_.folder);
    prepare_folder(options_.folder);
    events_.finished = [this](const Record& record, bool unchanged) {
      finished_.push_back(record);
      if (unchanged) ++unchanged_;
    };
    events_.check = [] {};
    events_.device = shared_device;
  }

  std::vector<std::string> library(int count) const {
    std::vector<std::string> assets;
    for (int i = 0; i < count; ++i)
      assets.push_back(folder_.write("asset" + std::to_string(i) + ".obj", triangle(i + 1)));
    return assets;
  }
  ProfileResult run(const std::vector<std::string>& assets) {
    Journal journal(options_.folder, {});
    const ProfileResult result = profile(assets, options_, journal, events_);
    journal.finish(assets);
    return result;
  }
  std::map<std::string, Record> records() const { return read_journals(options_.folder, 1).records; }

  TemporaryFolder folder_;
  ProfileOptions options_;
  ProfileEvents events_;
  std::vector<Record> finished_;
  int unchanged_ = 0;
};

TEST_F(ProfileTest, EveryAssetHasARecordAndAnAnalysisFile) {
  const auto assets = library(150);
  const ProfileResult result = run(assets);
  EXPECT_EQ(result.analysed, 150U);
  EXPECT_EQ(result.unchanged + result.failed + result.incomplete, 0U);
  const auto known = records();
  ASSERT_EQ(known.size(), 150U);
  for (const std::string& asset : assets) {
    const Record& record = known.at(asset);
    EXPECT_EQ(record.status, Status::kAnalysed);
    EXPECT_EQ(record.triangles, 1U);
    EXPECT_EQ(record.meshes, 1U);
    EXPECT_EQ(record.bytes, fs::file_size(asset));
    EXPECT_GT(record.import_seconds, 0);
    EXPECT_EQ(record.content_key.size(), 32U);
    EXPECT_TRUE(fs::exists(options_.folder / record.analysis)) << record.analysis;
  }
}

TEST_F(ProfileTest, WhatIsUnchangedIsNotMeasuredAgainAndKeepsItsRecord) {
  const auto assets = library(5);
  run(assets);
  const auto before = records();
  events_.device = []() -> gpu::Device& { throw gpu::NoDevice("nobody may ask"); };
  EXPECT_EQ(run(assets).unchanged, 5U);
  EXPECT_EQ(records(), before);
  unchanged_ = 0;
  events_.device = shared_device;
  folder_.write("asset3.obj", triangle(99));
  const ProfileResult result = run(assets);
  EXPECT_EQ(result.analysed, 5U);
  EXPECT_EQ(result.unchanged, 4U);
  EXPECT_EQ(unchanged_, 4);
  const auto after = records();
  for (std::size_t i = 0; i < assets.size(); ++i)
    EXPECT_EQ(after.at(assets[i]) == before.at(assets[i]), i != 3);
}

TEST_F(ProfileTest, OneBadAssetIsARecordAndTheOthersGoOn) {
  auto assets = library(3);
  assets.insert(assets.begin() + 1, folder_.write("bad.obj", "no model"));
  assets.push_back(folder_.path() / "missing.glb");
  const ProfileResult result = run(assets);
  EXPECT_EQ(result.analysed, 3U);
  EXPECT_EQ(result.failed, 2U);
  const auto known = records();
  EXPECT_EQ(known.at(assets[1]).status, Status::kFailed);
  EXPECT_THAT(known.at(assets[1]).reason, HasSubstr("bad.obj"));
  EXPECT_THAT(known.at(assets[4]).reason, AllOf(HasSubstr("missing.glb"), HasSubstr("no such file")));
  EXPECT_EQ(finished_.size(), 5U);
}

TEST_F(ProfileTest, WhatEndsTheRunLeavesWhatIsDone) {
  const auto assets = library(200);
  struct Stop {};
  events_.check = [&] {
    if (!finished_.empty()) throw Stop();
  };
  {
    Journal journal(options_.folder, {});
    EXPECT_THROW(profile(assets, options_, journal, events_), Stop);
  }
  const std::size_t done = records().size();
  EXPECT_EQ(done, finished_.size());
  EXPECT_LT(done, assets.size());
  events_.check = [] {};
  const ProfileResult result = run(assets);
  EXPECT_EQ(result.analysed, 200U);
  EXPECT_GE(result.unchanged, done);
}

TEST_F(ProfileTest, MemoryForScenesIsBounded) {
  options_.most_bytes = 1;
  EXPECT_EQ(run(library(20)).analysed, 20U);
  const auto assets = library(20);
  pipeline::Pipeline pipeline(options_.pipeline, shared_device);
  constexpr unsigned kThreads = 2;
  ImportPool pool(pipeline, assets, kThreads, 1);
  std::size_t taken = 0;
  std::uint64_t held = 0;
  while (const auto next = pool.take(std::chrono::steady_clock::now() + std::chrono::seconds(2))) {
    ++taken;
    held += next->bytes;
  }
  EXPECT_LE(taken, kThreads) << "the others wait until something is released, also those with analysis files";
  pool.release(held);
  EXPECT_TRUE(pool.take());
}

TEST_F(ProfileTest, APausedPoolImportsNothing) {
  const auto assets = library(20);
  pipeline::Pipeline pipeline(options_.pipeline, shared_device);
  ImportPool pool(pipeline, assets, 2, 1 << 30);
  pool.pause();
  while (pool.take(std::chrono::steady_clock::now())) {
  }
  EXPECT_FALSE(pool.take(std::chrono::steady_clock::now() + std::chrono::milliseconds(200)));
  pool.resume();
  EXPECT_TRUE(pool.take());
}

// Of two packs the first is lost while the second waits for its start triangles.
TEST_F(ProfileTest, ADeviceThatIsLostWhileAPackWaitsIsNotUsedByTheNext) {
  const auto assets = library(130);
  int asked = 0;
  events_.device = [&]() -> gpu::Device& {
    ++asked;
    return shared_device();
  };
  int records = 0;
  const auto finished = events_.finished;
  events_.finished = [&](const Record& record, bool unchanged) {
    finished(record, unchanged);
    if (++records == 10) throw gpu::DeviceLost("lost");
  };
  run(assets);
  EXPECT_EQ(asked, 2);
  std::set<std::string> names;
  for (const Record& record : finished_) names.insert(record.asset);
  EXPECT_EQ(names.size(), 130U);
  for (const auto& [asset, record] : this->records()) EXPECT_EQ(record.status, Status::kAnalysed) << asset;
}

TEST_F(ProfileTest, AnAssetOfWhichTheNameIsTooLongIsOneRecord) {
  auto assets = library(3);
  std::string name = folder_.path().string();
  while (name.size() < 3900) name += "/a_folder_with_a_long_name";
  fs::create_directories(name);
  name += "/" + std::string(4060 - name.size(), 'x') + ".obj";
  std::ofstream(name) << triangle(3);
  ASSERT_TRUE(fs::exists(name));
  assets.push_back(name);
  const ProfileResult result = run(assets);
  EXPECT_EQ(result.analysed, 3U);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_THAT(records().at(name).reason, HasSubstr("too long"));
}

TEST_F(ProfileTest, EachAssetIsKeptAsSoonAsItIsTimed) {
  options_.pipeline.metrics.set();
  options_.pipeline.parameters.steps = 1;
  options_.pipeline.timing_budget = 0.05;
  const auto assets = library(6);
  std::size_t at_first = 0;
  const auto finished = events_.finished;
  events_.finished = [&](const Record& record, bool unchanged) {
    finished(record, unchanged);
    for (const auto& entry : fs::recursive_directory_iterator(analyses_folder(options_.folder)))
      if (finished_.size() == 1 && entry.is_regular_file()) ++at_first;
  };
  EXPECT_EQ(run(assets).analysed, 6U);
  EXPECT_EQ(at_first, 1U);
}

TEST_F(ProfileTest, AnOutputFolderThatCannotBeWrittenEndsTheRun) {
  options_.pipeline.cache_folder = "/proc/no-such-folder";
  Journal journal(options_.folder, {});
  EXPECT_THROW(profile(library(3), options_, journal, events_), UsageError);
}

TEST_F(ProfileTest, WithoutADeviceThereIsNoRun) {
  events_.device = []() -> gpu::Device& { throw gpu::NoDevice("none"); };
  Journal journal(options_.folder, {});
  EXPECT_THROW(profile(library(3), options_, journal, events_), gpu::NoDevice);
}

TEST_F(ProfileTest, ADeviceThatIsLostOnceCostsNothingButTime) {
  int asked = 0;
  events_.device = [&]() -> gpu::Device& {
    if (++asked == 1) throw gpu::DeviceLost("lost");
    return shared_device();
  };
  EXPECT_EQ(run(library(10)).analysed, 10U);
  EXPECT_EQ(asked, 2);
}

TEST_F(ProfileTest, ADeviceThatIsLostTimeAndAgainEndsTheRun) {
  int asked = 0;
  events_.device = [&]() -> gpu::Device& {
    ++asked;
    throw gpu::DeviceLost("lost");
  };
  Journal journal(options_.folder, {});
  EXPECT_THROW(profile(library(10), options_, journal, events_), gpu::DeviceLost);
  EXPECT_EQ(asked, 4);
}

TEST_F(ProfileTest, NothingIsNothing) {
  EXPECT_EQ(run({}).analysed, 0U);
}

TEST_F(ProfileTest, APoolThatIsLeftEndsItsImports) {
  const auto assets = library(50);
  pipeline::Pipeline pipeline(options_.pipeline, shared_device);
  ImportPool pool(pipeline, assets, 4, 1 << 20);
  EXPECT_TRUE(pool.take());
}

}  // namespace
}  // namespace scene_analyzer::library
