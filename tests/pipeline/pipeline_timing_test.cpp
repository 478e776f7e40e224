// Rendering times: under which conditions they are stored, and when stored ones serve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis_file/analysis_file.h"
#include "pipeline/pipeline_fixture.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PipelineTimingTest : public PipelineTest {
 protected:
  PipelineTimingTest() {
    options_.metrics = only(Metric::kRenderingTime);
    options_.timing_budget = 0.01;
    options_.timing_width = options_.timing_height = 64;
    options_.parameters.steps = 2;
  }
  AssetAnalysis stored() const {
    return std::get<AssetAnalysis>(analysis_file::load(folder_.path() / "strip.obj.analysis"));
  }
};

TEST_F(PipelineTimingTest, TimesAreStoredUnderTheirConditions) {
  const Outcome first = analyze(strip());
  ASSERT_TRUE(first.analysis) << first.error;
  ASSERT_EQ(first.analysis->timings.size(), 1U);
  EXPECT_EQ(first.analysis->timings[0].conditions.device, first.analysis->device);
  EXPECT_GT(first.analysis->timings[0].times.at(0).mean_ns, 0);
  EXPECT_EQ(analyze_from_file(strip()).analysis->timings[0].times, first.analysis->timings[0].times);

  options_.parameters.steps = 1;
  const Outcome fewer = analyze(strip());
  EXPECT_FALSE(fewer.from_file);
  EXPECT_THAT(fewer.messages, IsEmpty()) << "nothing is wrong with the file";
  ASSERT_EQ(fewer.analysis->timings.size(), 1U) << "what was not asked for is not shown";
  EXPECT_EQ(fewer.analysis->timings[0].conditions.steps, 1U);
  ASSERT_EQ(stored().timings.size(), 2U) << "but kept";
  EXPECT_EQ(stored().timings[1].times, first.analysis->timings[0].times);

  options_.parameters.steps = 2;
  EXPECT_EQ(analyze_from_file(strip()).analysis->timings[0].times, first.analysis->timings[0].times);
  options_.timing_width = 65;
  EXPECT_FALSE(analyze(strip()).from_file);
}

TEST_F(PipelineTimingTest, TimesOfAnotherDeviceServeUntilADeviceIsNamed) {
  AssetAnalysis other = analyze(strip()).analysis.value();
  other.timings[0].conditions.device.name = "another device";
  analysis_file::store(folder_.path() / "strip.obj.analysis", other);
  EXPECT_EQ(analyze_from_file(strip()).analysis->timings[0].conditions.device.name, "another device");
  options_.this_device_only = true;
  const Outcome here = analyze(strip());
  EXPECT_FALSE(here.from_file);
  ASSERT_EQ(here.analysis->timings.size(), 1U);
  EXPECT_EQ(here.analysis->timings[0].conditions.device, here.analysis->device);
  ASSERT_EQ(stored().timings.size(), 2U);
  EXPECT_EQ(stored().timings[1].conditions.device.name, "another device");
  EXPECT_TRUE(analyze(strip()).from_file);
}

TEST_F(PipelineTimingTest, ALargerBudgetBettersTimesThatAreNotSure) {
  AssetAnalysis unsure = analyze(strip()).analysis.value();
  for (auto& time : unsure.timings[0].times) time.confidence_ns = time.mean_ns;
  analysis_file::store(folder_.path() / "strip.obj.analysis", unsure);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
  options_.timing_budget = 0.02;
  EXPECT_FALSE(analyze(strip()).from_file);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
  AssetAnalysis sure = stored();
  for (auto& time : sure.timings[0].times) {
    time.confidence_ns = 0;
    time.rotations = 4;
  }
  analysis_file::store(folder_.path() / "strip.obj.analysis", sure);
  options_.timing_budget = 1000;
  EXPECT_TRUE(analyze_from_file(strip()).from_file) << "nothing could be better";
}

TEST_F(PipelineTimingTest, RenderingIsNotTimedAgainForOtherMetrics) {
  const auto times = analyze(strip()).analysis->timings.at(0).times;
  options_.metrics = only(Metric::kFourierTransform);
  const Outcome other = analyze(strip());
  EXPECT_FALSE(other.from_file);
  EXPECT_TRUE(other.analysis->timings.empty()) << "not asked for";
  EXPECT_EQ(stored().timings.at(0).times, times);
  options_.metrics |= only(Metric::kRenderingTime);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
}

TEST_F(PipelineTimingTest, StoredTimesServeWhateverElseIsMeasured) {
  const auto times = analyze(strip()).analysis->timings.at(0).times;
  options_.histograms = [](const AssetAnalysis&, std::uint32_t, const analysis::Histogram&) {};
  const Outcome again = analyze(strip());
  EXPECT_FALSE(again.from_file);
  ASSERT_EQ(again.analysis->timings.size(), 1U);
  EXPECT_EQ(again.analysis->timings[0].times, times);
}

TEST_F(PipelineTimingTest, AFileFromBeforeThereWereDefectsServesWithItsTimesOnly) {
  AssetAnalysis old = analyze(strip()).analysis.value();
  const auto defects = old.geometries.at(0).defects;
  ASSERT_TRUE(defects);
  old.geometries[0].defects.reset();
  analysis_file::store(folder_.path() / "strip.obj.analysis", old);
  EXPECT_FALSE(analyze_from_file(strip()).analysis) << "the file lacks them";
  const Outcome again = analyze(strip());
  ASSERT_TRUE(again.analysis) << again.error;
  EXPECT_FALSE(again.from_file);
  EXPECT_THAT(again.messages, IsEmpty()) << "nothing is wrong with the file";
  EXPECT_EQ(again.analysis->geometries.at(0).defects, defects);
  EXPECT_EQ(again.analysis->timings.at(0).times, old.timings.at(0).times);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
}

TEST_F(PipelineTimingTest, WhereThereIsNothingToDrawTheFileServes) {
  const fs::path flat = folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n");
  ASSERT_TRUE(analyze(flat).analysis);
  EXPECT_TRUE(analyze_from_file(flat).from_file);
}

TEST_F(PipelineTimingTest, APictureThatTheDeviceCannotDrawCostsTheTimesOnly) {
  ASSERT_TRUE(analyze(strip()).analysis);
  options_.timing_width = 1'000'000;
  const Outcome outcome = analyze(strip());
  ASSERT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_TRUE(outcome.analysis->timings.empty());
  EXPECT_THAT(outcome.messages, ElementsAre(AllOf(HasSubstr("rendering time"), HasSubstr("1000000"))));
  EXPECT_EQ(outcome.analysis->geometries.at(0).triangles, 4U);
}

}  // namespace
}  // namespace scene_analyzer::pipeline
