// Asset path -> analysis: what is computed, what comes from the analysis file, what is said about it.
#include "pipeline/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "analysis_file/analysis_file.h"
#include "gpu/error.h"
#include "pipeline/pending_analysis.h"
#include "pipeline/pipeline_fixture.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using analysis::MetricSet;
using analysis::SignalSpectrum;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(PipelineTest, ComputesStoresAndReuses) {
  const Outcome first = analyze(strip());
  ASSERT_TRUE(first.analysis) << first.error;
  EXPECT_FALSE(first.from_file);
  EXPECT_THAT(first.messages, IsEmpty());
  ASSERT_EQ(first.analysis->instances.size(), 1U);
  const auto& geometry = first.analysis->geometries.at(0);
  EXPECT_EQ(geometry.triangles, 4U);
  EXPECT_EQ(geometry.planar_groups, 2U);
  EXPECT_NEAR(geometry.polygons_per_planar_group.value(), 2.0 / 3, 1e-9);
  EXPECT_EQ(first.analysis->asset, strip().string());
  EXPECT_EQ(first.analysis->device.name, shared_device().info().name);
  EXPECT_FALSE(first.analysis->files.empty());

  const Outcome second = analyze_from_file(strip());
  ASSERT_TRUE(second.analysis) << second.error;
  EXPECT_TRUE(second.from_file);
  EXPECT_THAT(second.messages, IsEmpty());
  EXPECT_EQ(second.analysis->device.name, first.analysis->device.name);
  EXPECT_EQ(second.analysis->geometries.at(0).cooccurrence_contrast, geometry.cooccurrence_contrast);
}

TEST_F(PipelineTest, WithoutTheFileNothingHelps) {
  // Proves that the trap of analyze_from_file() holds.
  const Outcome outcome = analyze_from_file(strip());
  EXPECT_FALSE(outcome.analysis);
  EXPECT_THAT(outcome.error, HasSubstr("strip.obj"));
}

TEST_F(PipelineTest, AnAnalysisFromAFileHasThePathGivenNow) {
  const fs::path asset = strip();
  ASSERT_TRUE(analyze(asset).analysis);
  const fs::path other = folder_.path() / "." / "strip.obj";
  EXPECT_EQ(analyze_from_file(other).analysis.value().asset, other.string());
}

TEST_F(PipelineTest, TheDeviceIsAskedForOnce) {
  int calls = 0;
  Pipeline pipeline(options_, [&]() -> gpu::Device& {
    ++calls;
    return shared_device();
  });
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(pipeline.analyze(strip()).analysis);
  EXPECT_TRUE(pipeline.analyze(folder_.write("b.obj", kStrip)).analysis);
  EXPECT_EQ(calls, 1);
}

TEST_F(PipelineTest, ErrorsOfTheDeviceReachTheCaller) {
  EXPECT_THROW(Pipeline(options_, []() -> gpu::Device& { throw gpu::NoDevice("none"); }).analyze(strip()),
               gpu::NoDevice);
}

TEST_F(PipelineTest, WithoutAnalysisFilesNothingIsReadOrWritten) {
  options_.use_analysis_files = false;
  ASSERT_TRUE(analyze(strip()).analysis);
  EXPECT_FALSE(fs::exists(folder_.path() / "strip.obj.analysis"));
  options_.use_analysis_files = true;
  ASSERT_TRUE(analyze(strip()).analysis);
  ASSERT_TRUE(fs::exists(folder_.path() / "strip.obj.analysis"));
  options_.use_analysis_files = false;
  EXPECT_FALSE(analyze(strip()).from_file);
}

TEST_F(PipelineTest, MetricsThatWereNotAskedForAreAddedLaterWithoutLosingOthers) {
  options_.metrics = only(Metric::kPlanarGroupVariation);
  const Outcome groups = analyze(strip());
  ASSERT_TRUE(groups.analysis) << groups.error;
  EXPECT_FALSE(groups.analysis->geometries.at(0).cooccurrence_contrast);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);

  options_.metrics = only(Metric::kCooccurrenceContrast);
  EXPECT_FALSE(analyze_from_file(strip()).analysis);
  const Outcome both = analyze(strip());
  ASSERT_TRUE(both.analysis) << both.error;
  EXPECT_FALSE(both.from_file);
  EXPECT_TRUE(both.analysis->geometries.at(0).cooccurrence_contrast);
  EXPECT_TRUE(both.analysis->geometries.at(0).planar_group_variation);

  options_.metrics = only(Metric::kPlanarGroupVariation);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
}

TEST_F(PipelineTest, MetricsThatNeedNoStageAreAlwaysCovered) {
  options_.metrics = only(Metric::kDistance);
  ASSERT_TRUE(analyze(strip()).analysis);
  options_.metrics = only(Metric::kRelativeDensity);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
}

TEST_F(PipelineTest, TheFourierRatingIsStoredUnderItsParameter) {
  options_.metrics = only(Metric::kDistance);
  ASSERT_TRUE(analyze(strip()).analysis);
  options_.metrics = only(Metric::kFourierTransform);
  EXPECT_FALSE(analyze_from_file(strip()).analysis) << "the file lacks it";
  ASSERT_TRUE(analyze(strip()).analysis);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
  options_.parameters.start_searches = 3;
  const Outcome other = analyze(strip());
  EXPECT_THAT(other.messages, ElementsAre(AllOf(HasSubstr("start searches"), HasSubstr("computed again"))));
}

TEST_F(PipelineTest, SignalsAreAlwaysMeasuredAndBringTheirRating) {
  ASSERT_TRUE(analyze(strip()).analysis);
  options_.metrics = only(Metric::kDistance);
  options_.signals = [](const AssetAnalysis& analysis, std::uint32_t geometry, const SignalSpectrum& signal) {
    const auto& summary = analysis.geometries.at(geometry).signal;
    ASSERT_TRUE(summary);
    EXPECT_EQ(signal.areas.size(), summary->length);
    EXPECT_EQ(signal.magnitudes.size(), summary->length / 2 + 1);
  };
  const Outcome outcome = analyze(strip());
  ASSERT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_FALSE(outcome.from_file);
  EXPECT_TRUE(outcome.analysis->computed[index_of(Metric::kFourierTransform)]);
}

TEST_F(PipelineTest, AChangedAssetOrParameterIsComputedAgainWithAMessage) {
  ASSERT_TRUE(analyze(strip()).analysis);
  folder_.write("strip.obj", std::string(kStrip) + "f 1 2 6\n");
  const Outcome changed = analyze(folder_.path() / "strip.obj");
  ASSERT_TRUE(changed.analysis) << changed.error;
  EXPECT_EQ(changed.analysis->geometries.at(0).triangles, 5U);
  EXPECT_THAT(changed.messages,
              ElementsAre(AllOf(HasSubstr("strip.obj.analysis"), HasSubstr("computed again"))));

  options_.parameters.alpha_degrees = 90;
  const Outcome wider = analyze(folder_.path() / "strip.obj");
  EXPECT_FALSE(wider.from_file);
  EXPECT_THAT(wider.messages, ElementsAre(HasSubstr("computed again")));
  EXPECT_TRUE(analyze_from_file(folder_.path() / "strip.obj").from_file);
}

TEST_F(PipelineTest, DamagedFilesAreComputedAgainWithAMessage) {
  ASSERT_TRUE(analyze(strip()).analysis);
  const fs::path file = folder_.path() / "strip.obj.analysis";
  const std::string whole = TemporaryFolder::read(file);
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x10);
  for (const std::string& damaged :
       {whole.substr(0, whole.size() / 2), std::string("x"), std::string(), flipped}) {
    folder_.write("strip.obj.analysis", damaged);
    const Outcome outcome = analyze(folder_.path() / "strip.obj");
    ASSERT_TRUE(outcome.analysis) << outcome.error;
    EXPECT_FALSE(outcome.from_file);
    EXPECT_THAT(outcome.messages,
                ElementsAre(AllOf(HasSubstr("strip.obj.analysis"), HasSubstr("computed again"))));
    EXPECT_EQ(TemporaryFolder::read(file), whole) << "the file is not replaced by a good one";
  }
}

TEST_F(PipelineTest, AssetsMayBeStartedBeforeOthersAreFinished) {
  Pipeline pipeline(options_, shared_device);
  const std::vector<fs::path> assets = {strip(), folder_.write("bad.obj", "no model"),
                                        folder_.write("other.obj", kStrip), folder_.path() / "missing.obj"};
  std::vector<std::unique_ptr<PendingAnalysis>> pending;
  for (const fs::path& asset : assets) pending.push_back(pipeline.start(asset));
  EXPECT_FALSE(fs::exists(folder_.path() / "strip.obj.analysis")) << "stored before it was finished";
  for (const std::size_t i : {1U, 2U, 0U, 3U}) {
    const Outcome outcome = pipeline.finish(std::move(pending[i]));
    EXPECT_EQ(outcome.analysis.has_value(), i == 0 || i == 2) << outcome.error;
    if (outcome.analysis) {
      EXPECT_TRUE(outcome.analysis->geometries.at(0).fourier_transform);
      EXPECT_TRUE(analyze_from_file(assets[i]).from_file);
    } else {
      EXPECT_THAT(outcome.error, HasSubstr(assets[i].filename().string()));
    }
  }
}

TEST_F(PipelineTest, AnAssetThatWasStartedOutlivesTheFailureOfTheNext) {
  struct Stop {};
  Pipeline pipeline(options_, shared_device);
  auto first = pipeline.start(strip());
  EXPECT_THROW(pipeline.start(folder_.write("other.obj", kStrip),
                              [](double fraction, const std::string&) {
                                if (fraction > 0) throw Stop();
                              }),
               Stop);
  EXPECT_TRUE(pipeline.finish(std::move(first)).analysis);
  EXPECT_TRUE(analyze_from_file(strip()).from_file);
}

TEST_F(PipelineTest, AnAssetThatIsDroppedLeavesNoAnalysisFile) {
  Pipeline pipeline(options_, shared_device);
  pipeline.start(strip()).reset();
  EXPECT_FALSE(fs::exists(folder_.path() / "strip.obj.analysis"));
  EXPECT_TRUE(pipeline.analyze(strip()).analysis);
}

TEST_F(PipelineTest, FoldersThatCannotBeWrittenAreNamedOnce) {
  options_.cache_folder = "/proc/no-such-folder";  // not even root can make it
  Pipeline pipeline(options_, shared_device);
  const Outcome first = pipeline.analyze(strip());
  ASSERT_TRUE(first.analysis) << first.error;
  EXPECT_THAT(first.messages, ElementsAre(AllOf(HasSubstr("/proc/no-such-folder"), HasSubstr("--cache-dir"),
                                                HasSubstr("--no-cache"), HasSubstr("not kept"))));
  const Outcome second = pipeline.analyze(folder_.write("b.obj", kStrip));
  ASSERT_TRUE(second.analysis) << second.error;
  EXPECT_THAT(second.messages, IsEmpty());
}

TEST_F(PipelineTest, BadAssetsAreOutcomes) {
  fs::create_directory(folder_.path() / "folder.obj");
  for (const fs::path& asset :
       {folder_.path() / "missing.obj", folder_.path() / "folder.obj", folder_.write("empty.obj", ""),
        folder_.write("noise.glb", "no glTF at all"), folder_.path() / std::string(300, 'x')}) {
    const Outcome outcome = analyze(asset);
    EXPECT_FALSE(outcome.analysis) << asset;
    EXPECT_THAT(outcome.error, HasSubstr(asset.filename().string().substr(0, 20)));
    EXPECT_FALSE(outcome.from_file);
  }
}

TEST_F(PipelineTest, AssetsWithoutTrianglesAreSaidSo) {
  const Outcome degenerate =
      analyze(folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n"));
  ASSERT_TRUE(degenerate.analysis) << degenerate.error;
  EXPECT_EQ(degenerate.analysis->instances.size(), 1U);
  EXPECT_THAT(degenerate.messages, Contains(AllOf(HasSubstr("flat.obj"), HasSubstr("degenerate"))));
  const Outcome again = analyze_from_file(folder_.path() / "flat.obj");
  ASSERT_TRUE(again.analysis) << again.error;
  EXPECT_THAT(again.messages, Contains(HasSubstr("degenerate"))) << "a stored analysis keeps its warnings";
}

TEST_F(PipelineTest, ProgressGoesUpAndNamesItsSteps) {
  double last = 0;
  std::set<std::string> steps;
  const auto progress = [&](double fraction, const std::string& step) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    steps.insert(step);
  };
  ASSERT_TRUE(Pipeline(options_, shared_device).analyze(strip(), progress).analysis);
  EXPECT_THAT(
      steps, testing::IsSupersetOf({"checking the analysis file", "importing", "writing the analysis file"}));
}

}  // namespace
}  // namespace scene_analyzer::pipeline
