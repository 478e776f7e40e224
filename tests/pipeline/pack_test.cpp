// Assets measured together: each has what it would have had alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "import/import.h"
#include "pipeline/joined_scene.h"
#include "pipeline/pending_pack.h"
#include "pipeline/pipeline.h"
#include "pipeline/strip.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::Metric;
using testing::HasSubstr;
using testing::SizeIs;

class PackTest : public testing::Test {
 protected:
  PackTest() { options_.metrics.reset(index_of(Metric::kRenderingTime)); }

  // Their files below "alone" and "together" are compared.
  std::string stored(const fs::path& asset, const char* cache) {
    return TemporaryFolder::read(analysis_file::path_for(asset, folder_.path() / cache));
  }
  Pipeline pipeline(const char* cache) {
    Options options = options_;
    options.cache_folder = folder_.path() / cache;
    return {options, shared_device};
  }
  static std::vector<Outcome> analyze_together(Pipeline& pipeline, const std::vector<fs::path>& assets) {
    std::vector<std::unique_ptr<PendingAnalysis>> prepared;
    for (const fs::path& asset : assets) prepared.push_back(pipeline.prepare(asset));
    return finish(pipeline, std::move(prepared));
  }
  static std::vector<Outcome> finish(Pipeline& pipeline,
                                     std::vector<std::unique_ptr<PendingAnalysis>> prepared) {
    std::vector<Outcome> outcomes;
    pipeline.finish_pack(pipeline.start_pack(std::move(prepared)), [&](std::size_t index, Outcome outcome) {
      EXPECT_EQ(index, outcomes.size());
      outcomes.push_back(std::move(outcome));
    });
    return outcomes;
  }

  TemporaryFolder folder_;
  Options options_;
};

TEST_F(PackTest, WritesTheFilesThatEachAssetWouldHaveHadAlone) {
  std::vector<fs::path> assets;
  for (int i = 1; i <= 12; ++i)
    assets.push_back(
        folder_.write("strip" + std::to_string(i) + ".obj", strip(7 * i, i % 3 == 0, std::pow(11.0, i - 6))));
  assets.push_back(folder_.write("nothing.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n"));
  Pipeline alone = pipeline("alone"), together = pipeline("together");
  for (const fs::path& asset : assets) ASSERT_TRUE(alone.analyze(asset).analysis);
  const std::vector<Outcome> outcomes = analyze_together(together, assets);
  ASSERT_THAT(outcomes, SizeIs(assets.size()));
  for (std::size_t i = 0; i < assets.size(); ++i) {
    ASSERT_TRUE(outcomes[i].analysis) << outcomes[i].error;
    EXPECT_TRUE(outcomes[i].kept);
    EXPECT_EQ(outcomes[i].analysis->asset, assets[i].string());
    ASSERT_FALSE(stored(assets[i], "alone").empty());
    EXPECT_TRUE(stored(assets[i], "together") == stored(assets[i], "alone")) << assets[i];
  }
}

TEST_F(PackTest, BadAssetsAndKnownOnesAreNoTroubleToTheOthers) {
  const std::vector<fs::path> assets = {
      folder_.write("a.obj", strip(3, false)), folder_.write("bad.obj", "no model"),
      folder_.write("known.obj", strip(4, false)), folder_.path() / "missing.obj",
      folder_.write("b.obj", strip(5, true))};
  Pipeline pipeline = this->pipeline("together");
  ASSERT_TRUE(pipeline.analyze(assets[2]).analysis);
  const std::vector<Outcome> outcomes = analyze_together(pipeline, assets);
  ASSERT_THAT(outcomes, SizeIs(5));
  for (const std::size_t good : {0U, 2U, 4U}) EXPECT_TRUE(outcomes[good].analysis) << outcomes[good].error;
  EXPECT_TRUE(outcomes[2].from_file);
  EXPECT_FALSE(outcomes[0].from_file);
  EXPECT_THAT(outcomes[1].error, HasSubstr("bad.obj"));
  EXPECT_THAT(outcomes[3].error, HasSubstr("missing.obj"));
  EXPECT_FALSE(outcomes[1].may_succeed_alone);
}

TEST_F(PackTest, AssetsThatNeedOtherMetricsKeepThem) {
  const std::vector<fs::path> assets = {folder_.write("new.obj", strip(3, false)),
                                        folder_.write("more.obj", strip(4, false)),
                                        folder_.write("newer.obj", strip(5, false))};
  {
    Pipeline all = pipeline("together");
    ASSERT_TRUE(all.analyze(assets[1]).analysis);
  }
  options_.metrics.reset().set(index_of(Metric::kPolygonsPerPlanarGroup));
  ASSERT_TRUE(pipeline("together").analyze(assets[0]).analysis);
  options_.metrics.reset().set(index_of(Metric::kCooccurrenceContrast));
  Pipeline together = pipeline("together");
  const std::vector<Outcome> outcomes = analyze_together(together, assets);
  EXPECT_TRUE(outcomes[0].analysis.value().geometries[0].polygons_per_planar_group);
  EXPECT_TRUE(outcomes[0].analysis->geometries[0].cooccurrence_contrast);
  EXPECT_TRUE(outcomes[1].from_file);
  EXPECT_FALSE(outcomes[2].analysis.value().geometries[0].polygons_per_planar_group);
  EXPECT_TRUE(outcomes[2].analysis->geometries[0].cooccurrence_contrast);
}

TEST_F(PackTest, RenderingIsTimedAssetByAsset) {
  options_.metrics.set(index_of(Metric::kRenderingTime));
  options_.timing_budget = 0.05;
  options_.parameters.steps = 1;
  const std::vector<fs::path> assets = {folder_.write("a.obj", strip(3, true)),
                                        folder_.write("b.obj", strip(40, true))};
  Pipeline pipeline = this->pipeline("together");
  for (const Outcome& outcome : analyze_together(pipeline, assets)) {
    ASSERT_TRUE(outcome.analysis) << outcome.error;
    ASSERT_THAT(outcome.analysis->timings, SizeIs(1));
    ASSERT_THAT(outcome.analysis->timings[0].times, SizeIs(2));
    for (const auto& time : outcome.analysis->timings[0].times)
      EXPECT_GT(time.mean_ns, 0) << time.not_measured;
  }
}

TEST_F(PackTest, SeveralThreadsMayPrepare) {
  options_.metrics.set(index_of(Metric::kRenderingTime));  // with which the device's name is asked for
  options_.this_device_only = true;
  options_.timing_budget = 0.05;
  options_.parameters.steps = 1;
  constexpr int kAssets = 12;
  Pipeline pipeline = this->pipeline("together");
  std::vector<std::unique_ptr<PendingAnalysis>> prepared(kAssets);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kAssets; ++i) {
      const fs::path asset = folder_.write(std::to_string(i) + ".obj", strip(i + 1, false));
      threads.emplace_back(
          [&, i, asset] { prepared[static_cast<std::size_t>(i)] = pipeline.prepare(asset); });
    }
  }
  for (const Outcome& outcome : finish(pipeline, std::move(prepared)))
    EXPECT_TRUE(outcome.analysis) << outcome.error;
}

TEST_F(PackTest, ADeviceThatIsForgottenIsAskedForAgain) {
  int asked = 0;
  Pipeline pipeline(options_, [&]() -> gpu::Device& {
    ++asked;
    return shared_device();
  });
  auto pending = pipeline.prepare(folder_.write("a.obj", strip(3, false)));
  ASSERT_TRUE(pipeline.analyze(folder_.write("b.obj", strip(3, false))).analysis);
  pipeline.forget_device();
  std::vector<std::unique_ptr<PendingAnalysis>> one;
  one.push_back(std::move(pending));
  EXPECT_TRUE(finish(pipeline, std::move(one)).at(0).analysis);
  EXPECT_EQ(asked, 2);
}

TEST(JoinedScene, OfNothingIsNothing) {
  const JoinedScene joined = join({});
  EXPECT_TRUE(joined.scene.meshes.empty());
  EXPECT_EQ(joined.first_meshes, std::vector<std::uint32_t>{0});
  split(joined, {}, {});
}

}  // namespace
}  // namespace scene_analyzer::pipeline
