// The signal of a selected mesh, beside what the analysis itself has measured.
#include "viewer/signal_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include "import/gltf_builder.h"
#include "pipeline/pipeline.h"
#include "support/gpu_test.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::seconds kPatience(120);

MATCHER_P(HasExtremes, expected, "") {
  return std::ranges::equal(arg, expected, [](const report::Extremes& a, const report::Extremes& b) {
    return a.least == b.least && a.greatest == b.greatest;
  });
}

struct Measured {
  AssetAnalysis analysis;
  std::map<std::uint32_t, SignalCurves> curves;  // of the geometries that have a signal
};

class SignalJobTest : public test::GpuTest {
 protected:
  // As `analyze --signals` measures them.
  Measured measure(const fs::path& asset) {
    Measured measured;
    pipeline::Options options;
    options.metrics = analysis::MetricSet().set(index_of(analysis::Metric::kFourierTransform));
    options.use_analysis_files = false;
    options.signals = [&](const AssetAnalysis&, std::uint32_t geometry, const auto& signal) {
      SignalCurves& curves = measured.curves[geometry];
      if (!signal.areas.empty()) curves.areas = report::envelope(signal.areas, kCurveColumns);
      if (signal.magnitudes.size() > 1)
        curves.magnitudes = report::envelope(signal.magnitudes.subspan(1), kCurveColumns);
      curves.length = signal.areas.size();
    };
    pipeline::Pipeline pipeline(options, [this]() -> gpu::Device& { return device(); });
    const pipeline::Outcome outcome = pipeline.analyze(asset, [](double, const std::string&) {});
    EXPECT_TRUE(outcome.analysis) << outcome.error;
    measured.analysis = outcome.analysis.value_or(AssetAnalysis());
    return measured;
  }

  static SignalJob::State wait_for(const SignalJob& job) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    SignalJob::State state = job.state();
    while (!state.curves && state.error.empty() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      state = job.state();
    }
    return state;
  }

  static void expect_same(const SignalJob::State& state, const Measured& measured) {
    ASSERT_TRUE(state.curves) << state.error;
    const SignalCurves& expected = measured.curves.at(state.wanted->geometry);
    EXPECT_EQ(state.curves->length, expected.length);
    EXPECT_THAT(state.curves->areas, HasExtremes(expected.areas));
    EXPECT_THAT(state.curves->magnitudes, HasExtremes(expected.magnitudes));
  }

  TemporaryFolder folder_;
};

TEST_F(SignalJobTest, GivesTheSignalsOfTheAnalysisBitByBit) {
  const Measured room = measure(fs::path(SCENE_ANALYZER_SOURCE_DIR) / "examples/living-room.glb");
  ASSERT_GT(room.curves.size(), 10U);
  SignalJob job(test::device_options(), {});
  std::size_t compared = 0;
  for (const auto& [geometry, curves] : room.curves) {
    if (curves.length == 0 || curves.length > 2000) continue;  // the cushions take a while
    SCOPED_TRACE(geometry);
    job.ask({.asset = 7, .geometry = geometry}, room.analysis);
    const SignalJob::State state = wait_for(job);
    EXPECT_EQ(state.wanted, (SignalJob::Wanted{7, geometry}));
    expect_same(state, room);
    const auto& magnitudes = state.curves->magnitudes;
    const auto highest = std::ranges::max_element(magnitudes, {}, &report::Extremes::greatest);
    if (highest != magnitudes.end()) {
      EXPECT_EQ(state.curves->largest_magnitude, highest->greatest);
    }
    ++compared;
  }
  EXPECT_GE(compared, 10U);
  EXPECT_THAT(job.take_validation_messages(), IsEmpty());
}

TEST_F(SignalJobTest, StretchedMeshesAreMeasuredStretched) {
  import::QuadGltf quad;
  quad.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 3, 0};
  quad.root["nodes"] = {{{"mesh", 0}, {"scale", {1, 4, 2}}}, {{"mesh", 0}, {"scale", {3, 3, 3}}}};
  quad.root["scenes"] = {{{"nodes", {0, 1}}}};
  const Measured measured = measure(folder_.write("quads.gltf", quad.text()));
  ASSERT_EQ(measured.curves.size(), 2U);
  SignalJob job(test::device_options(), {});
  for (const std::uint32_t geometry : {0U, 1U}) {
    job.ask({.geometry = geometry}, measured.analysis);
    expect_same(wait_for(job), measured);
  }
}

TEST_F(SignalJobTest, TheLatestWishCounts) {
  const Measured room = measure(fs::path(SCENE_ANALYZER_SOURCE_DIR) / "examples/living-room.glb");
  std::uint32_t largest = 0, small = 0;
  for (const auto& [geometry, curves] : room.curves) {
    if (curves.length > room.curves.at(largest).length) largest = geometry;
    if (curves.length == 40) small = geometry;
  }
  ASSERT_NE(largest, small);
  SignalJob job(test::device_options(), {});
  for (int i = 0; i < 20; ++i) job.ask({.geometry = i % 2 == 0 ? largest : small}, room.analysis);
  const SignalJob::State state = wait_for(job);
  EXPECT_EQ(state.wanted->geometry, small);
  expect_same(state, room);
  job.ask({.geometry = small}, room.analysis);
  EXPECT_TRUE(job.state().curves) << "what is known is not measured again";
  const auto begin = std::chrono::steady_clock::now();
  {
    SignalJob closed(test::device_options(), {});
    closed.ask({.geometry = largest}, room.analysis);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20))
      << "it ends when it is closed";
}

TEST_F(SignalJobTest, AFileThatIsGoneIsAReason) {
  const fs::path asset = folder_.write("fold.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const Measured measured = measure(asset);
  fs::remove(asset);
  SignalJob job(test::device_options(), {});
  job.ask({}, measured.analysis);
  const SignalJob::State state = wait_for(job);
  EXPECT_FALSE(state.curves);
  EXPECT_THAT(state.error, HasSubstr("fold.obj"));
  folder_.write("fold.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  job.ask({.asset = 1}, measured.analysis);
  expect_same(wait_for(job), measured);
}

}  // namespace
}  // namespace scene_analyzer::viewer
