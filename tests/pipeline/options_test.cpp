// Assets with options of their own, alone and in packs: each has what a pipeline of these options gives it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "analysis_file/analysis_file.h"
#include "pipeline/pending_pack.h"
#include "pipeline/pipeline.h"
#include "pipeline/strip.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class OptionsTest : public testing::Test {
 protected:
  OptionsTest() {
    plain_.metrics.reset(index_of(Metric::kRenderingTime));
    plain_.use_analysis_files = false;
  }

  // An asset with its options; without any, the pipeline's.
  struct Given {
    fs::path asset;
    std::shared_ptr<const Options> options;
  };
  // The plain ones after `change`.
  template <typename Change>
  std::shared_ptr<const Options> options(Change change) const {
    Options changed = plain_;
    change(changed);
    return std::make_shared<const Options>(std::move(changed));
  }
  fs::path asset(int quads) const {
    return folder_.write("strip" + std::to_string(quads) + ".obj", strip(quads, true));
  }
  // What makes different analyses of the same strip.
  std::vector<std::shared_ptr<const Options>> differing() const {
    return {options([](Options& one) { one.parameters.alpha_degrees = 180; }),
            options([](Options& one) { one.parameters.dim = 2; }),
            options([](Options& one) { one.parameters.weld_tolerance = 1.25; }),
            options([](Options& one) { one.parameters.start_searches = 1; }),
            options([](Options& one) { one.metrics.reset(index_of(Metric::kFourierTransform)); }),
            options([](Options& one) { one.metrics.reset().set(index_of(Metric::kPlanarGroupVariation)); })};
  }

  std::vector<Outcome> analyze_together(const std::vector<Given>& assets) const {
    Pipeline pipeline(plain_, shared_device);
    std::vector<std::unique_ptr<PendingAnalysis>> prepared;
    for (const Given& one : assets) prepared.push_back(pipeline.prepare(one.asset, {}, one.options));
    std::vector<Outcome> outcomes;
    pipeline.finish_pack(pipeline.start_pack(std::move(prepared)),
                         [&](std::size_t, Outcome outcome) { outcomes.push_back(std::move(outcome)); });
    return outcomes;
  }
  Outcome alone(const Given& one) const {
    return Pipeline(one.options ? *one.options : plain_, shared_device).analyze(one.asset);
  }
  // Everything that is stored of it,
  std::string bytes_of(const Outcome& outcome) const {
    return outcome.analysis ? bytes_of(*outcome.analysis) : "not analysed: " + outcome.error;
  }
  // and that but the parameters.
  std::string results_of(AssetAnalysis analysis) const {
    analysis.parameters = {};
    return bytes_of(std::move(analysis));
  }
  std::string bytes_of(AssetAnalysis analysis) const {
    const fs::path file = folder_.path() / "compared.analysis";
    analysis.files = analysis_file::fingerprint(analysis.asset, {});
    analysis_file::store(file, analysis);
    return TemporaryFolder::read(file);
  }

  const TemporaryFolder folder_;
  Options plain_;
};

TEST_F(OptionsTest, AnAssetsOwnReplaceThePipelines) {
  const fs::path asset = this->asset(9);
  std::set<std::string> different = {results_of(alone({asset, nullptr}).analysis.value())};
  Pipeline pipeline(plain_, shared_device);
  for (auto own : differing()) {
    const Outcome expected = alone({asset, own});
    EXPECT_TRUE(different.insert(results_of(expected.analysis.value())).second) << "or nothing is proven";
    auto pending = pipeline.prepare(asset, {}, own);
    own.reset();  // it keeps them
    std::vector<std::unique_ptr<PendingAnalysis>> one;
    one.push_back(std::move(pending));
    pipeline.finish_pack(pipeline.start_pack(std::move(one)), [&](std::size_t, const Outcome& outcome) {
      EXPECT_TRUE(bytes_of(outcome) == bytes_of(expected)) << outcome.error;
    });
  }
  EXPECT_TRUE(bytes_of(pipeline.analyze(asset)) == bytes_of(alone({asset, nullptr})))
      << "the others' are as before";
}

TEST_F(OptionsTest, APackMayMixThem) {
  std::vector<Given> assets;
  int quads = 3;
  for (const auto& own : differing()) {
    // Two like the first one, two like each other.
    for (const auto& one : {std::shared_ptr<const Options>(), own, own})
      assets.push_back({asset(quads++), one});
  }
  const std::vector<Outcome> outcomes = analyze_together(assets);
  ASSERT_THAT(outcomes, SizeIs(assets.size()));
  for (std::size_t i = 0; i < assets.size(); ++i) {
    ASSERT_TRUE(outcomes[i].analysis) << outcomes[i].error;
    EXPECT_EQ(outcomes[i].analysis->parameters, (assets[i].options ? *assets[i].options : plain_).parameters);
    EXPECT_TRUE(bytes_of(outcomes[i]) == bytes_of(alone(assets[i]))) << i;
  }
}

TEST_F(OptionsTest, TheFirstOfAPackMayBeThoseThatDiffer) {
  const auto own = differing().front();
  const std::vector<Given> assets = {
      {asset(3), own}, {asset(4), own}, {asset(5), nullptr}, {asset(6), nullptr}};
  const std::vector<Outcome> outcomes = analyze_together(assets);
  for (std::size_t i = 0; i < assets.size(); ++i)
    EXPECT_TRUE(bytes_of(outcomes.at(i)) == bytes_of(alone(assets[i]))) << i;
}

TEST_F(OptionsTest, LimitsAreTheAssetsOwn) {
  const auto few = options([](Options& one) { one.import_limits.triangles = 10; });
  const std::vector<Outcome> outcomes =
      analyze_together({{asset(3), few}, {asset(40), few}, {asset(41), nullptr}});
  EXPECT_TRUE(outcomes.at(0).analysis) << outcomes[0].error;
  EXPECT_THAT(outcomes.at(1).error, AllOf(HasSubstr("strip40.obj"), HasSubstr("--max-triangles")));
  EXPECT_TRUE(outcomes.at(2).analysis) << outcomes[2].error;
}

TEST_F(OptionsTest, WhereAnalysesAreKeptIsTheAssetsOwn) {
  const auto cache = [this](const char* name) { return folder_.path() / name; };
  const auto kept_in = [&](const char* name) {
    return options([&](Options& one) {
      one.use_analysis_files = true;
      one.cache_folder = cache(name);
    });
  };
  const auto beside = options([](Options& one) { one.use_analysis_files = true; });
  const auto named = options([](Options& one) { one.fingerprint_files = true; });
  const std::vector<Given> assets = {{asset(3), kept_in("one")},
                                     {asset(4), kept_in("other")},
                                     {asset(5), beside},
                                     {asset(6), nullptr},
                                     {asset(7), named}};
  const auto places = [&](const fs::path& asset) {
    std::string found;
    for (const char* name : {"one", "other"})
      if (fs::exists(analysis_file::path_for(asset, cache(name)))) found += name;
    return found + (fs::exists(analysis_file::path_for(asset, {})) ? "beside" : "");
  };
  const std::vector<Outcome> outcomes = analyze_together(assets);
  std::vector<std::string> found;
  for (const Given& one : assets) found.push_back(places(one.asset));
  EXPECT_THAT(found, testing::ElementsAre("one", "other", "beside", "", ""));
  for (std::size_t i = 0; i < assets.size(); ++i) {
    EXPECT_EQ(outcomes.at(i).kept, i < 3) << i;
    EXPECT_THAT(outcomes[i].analysis.value().files, SizeIs(i == 3 ? 0 : 1)) << i;
    EXPECT_THAT(outcomes[i].messages, IsEmpty());
  }
  const std::vector<Outcome> again = analyze_together(assets);
  for (std::size_t i = 0; i < assets.size(); ++i) EXPECT_EQ(again.at(i).from_file, i < 3) << i;
}

TEST_F(OptionsTest, RenderingTimesAreMadeAsEachAssetAsks) {
  const auto timed = [this](std::uint32_t width, std::uint32_t steps, double budget) {
    return options([=](Options& one) {
      one.metrics.set(index_of(Metric::kRenderingTime));
      one.timing_width = one.timing_height = width;
      one.parameters.steps = steps;
      one.timing_budget = budget;
    });
  };
  const std::vector<Given> assets = {{asset(3), timed(64, 1, 0.02)},
                                     {asset(4), timed(65, 1, 0.03)},
                                     {asset(5), timed(66, 2, 0.02)},
                                     {asset(6), nullptr}};
  const std::vector<Outcome> outcomes = analyze_together(assets);
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    const auto& timings = outcomes.at(i).analysis.value().timings;
    ASSERT_THAT(timings, SizeIs(1));
    EXPECT_EQ(timings[0].conditions.width, assets[i].options->timing_width);
    EXPECT_EQ(timings[0].conditions.height, assets[i].options->timing_height);
    EXPECT_EQ(timings[0].conditions.steps, assets[i].options->parameters.steps);
    EXPECT_EQ(timings[0].budget_seconds, assets[i].options->timing_budget);
    ASSERT_THAT(timings[0].times, SizeIs(outcomes[i].analysis->geometries.size()));
    for (const auto& time : timings[0].times) EXPECT_GT(time.mean_ns, 0) << time.not_measured;
  }
  EXPECT_THAT(outcomes.at(3).analysis.value().timings, IsEmpty());
}

TEST_F(OptionsTest, WhetherAnAssetIsTimedAloneIsAskedOfItsOptions) {
  Pipeline pipeline(plain_, shared_device);
  const auto timed = options([](Options& one) { one.metrics.set(index_of(Metric::kRenderingTime)); });
  EXPECT_FALSE(pipeline.is_timed_alone(*timed)) << "no device is known yet";
  pipeline.device();
  EXPECT_FALSE(pipeline.is_timed_alone());
  EXPECT_EQ(pipeline.is_timed_alone(*timed), shared_device().info().type != gpu::DeviceType::kDiscrete);
  EXPECT_FALSE(Pipeline(*timed, shared_device).is_timed_alone());
}

}  // namespace
}  // namespace scene_analyzer::pipeline
