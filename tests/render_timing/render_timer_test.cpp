// Meshes through the device: what is counted exactly, how budgets are kept, what cannot be measured.
// How long drawing takes is no matter of tests: see bench/.
#include "render_timing/render_timer.h"

#include <cmath>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "support/gpu_test.h"
#include "support/meshes.h"

namespace scene_analyzer::render_timing {
namespace {

using analysis::RenderingTime;
using test_meshes::TestMesh;
using testing::HasSubstr;

class RenderTimerTest : public test::GpuTest {
 protected:
  static const RenderTimer& timer() {
    static auto& kept = *new RenderTimer(device());
    return kept;
  }
  void SetUp() override {
    if (!why_not(device().info()).empty()) GTEST_SKIP() << why_not(device().info());
  }
  static std::vector<RenderingTime> measure(const std::vector<TestMesh>& meshes,
                                            const TimingOptions& options) {
    std::vector<TimedMesh> timed;
    for (const TestMesh& mesh : meshes)
      timed.push_back({.positions = mesh.positions, .indices = mesh.indices});
    return timer().measure(timed, options);
  }
};

TEST_F(RenderTimerTest, EveryMeshHasItsTimeInOrder) {
  const std::vector<TestMesh> meshes = {test_meshes::cube(), test_meshes::geosphere(20),
                                        test_meshes::grid(4, 4)};
  const auto times = measure(meshes, {.width = 64, .height = 64, .steps = 2, .budget_seconds = 2});
  ASSERT_EQ(times.size(), 3U);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const RenderingTime& time = times[i];
    EXPECT_EQ(time.not_measured, "");
    EXPECT_GT(time.mean_ns, 0);
    EXPECT_LE(time.fastest_ns, time.mean_ns);
    EXPECT_GE(time.slowest_ns, time.mean_ns);
    EXPECT_EQ(time.rotations, 4U);
    EXPECT_GE(time.rounds, 1U);
    if (!device().info().counts_invocations) continue;
    // No vertex less than once, none more often than triangles use it.
    EXPECT_GE(time.vertex_invocations.value(), static_cast<double>(meshes[i].vertex_count()));
    EXPECT_LE(time.vertex_invocations.value(), static_cast<double>(meshes[i].indices.size()));
  }
}

// A square in its bounding circle covers half of the view's square: 1/sqrt(2) of the smaller side each way.
TEST_F(RenderTimerTest, TheBoundingSphereFillsTheView) {
  if (!device().info().counts_invocations) GTEST_SKIP() << "the device does not count";
  for (const auto& [width, height] : {std::pair(256U, 256U), std::pair(400U, 128U), std::pair(100U, 300U)}) {
    const auto times = measure({test_meshes::grid(1, 1)},
                               {.width = width, .height = height, .steps = 1, .budget_seconds = 0.001});
    const double side = std::min(width, height) / std::sqrt(2.0);
    const double covered = *times[0].fragment_invocations / *times[0].overdraw;
    EXPECT_NEAR(covered, side * side, 2 * side) << width << " x " << height;
  }
}

TEST_F(RenderTimerTest, LittleTimeMeansFewerRotationsTheSameForAll) {
  const auto times = measure({test_meshes::cube(), test_meshes::geosphere(30)},
                             {.width = 64, .height = 64, .steps = 40, .budget_seconds = 0.05});
  ASSERT_EQ(times.size(), 2U);
  EXPECT_GE(times[0].rotations, 1U);
  EXPECT_LT(times[0].rotations, 1600U);
  EXPECT_EQ(times[1].rotations, times[0].rotations);
  EXPECT_EQ(times[0].rounds, times[1].rounds);
}

TEST_F(RenderTimerTest, RoundsEndWhenTheTimesAreSureAndNoEarlier) {
  const TimingOptions once{.width = 32, .height = 32, .steps = 1, .budget_seconds = 2, .precision = 1e9};
  EXPECT_EQ(measure({test_meshes::cube()}, once).at(0).rounds, 6U) << "sure after 5 rounds and after 6";
  TimingOptions never = once;
  never.precision = -1;
  EXPECT_GT(measure({test_meshes::cube()}, never).at(0).rounds, 20U) << "the budget is not spent";
}

TEST_F(RenderTimerTest, OverdrawIsFragmentsPerCoveredPixelOfAllRotations) {
  if (!device().info().counts_invocations) GTEST_SKIP() << "the device does not count";
  // Two squares, one behind the other: from the front and from the back half of what is drawn may be hidden.
  TestMesh two = test_meshes::grid(1, 1);
  const auto vertices = static_cast<std::uint32_t>(two.vertex_count());
  for (std::uint32_t v = 0; v < vertices; ++v)
    two.vertex(two.positions[3 * v], two.positions[3 * v + 1], two.positions[3 * v + 2] + 0.001F);
  for (std::size_t i = 0, count = two.indices.size(); i < count; i += 3)
    two.triangle(two.indices[i] + vertices, two.indices[i + 1] + vertices, two.indices[i + 2] + vertices);
  const RenderingTime time =
      measure({two}, {.width = 256, .height = 256, .steps = 2, .budget_seconds = 2}).at(0);
  ASSERT_EQ(time.rotations, 4U);
  // Two of the four rotations see the squares from the side that has the second one in front.
  EXPECT_GT(time.overdraw.value(), 1.3);
  EXPECT_LT(time.overdraw.value(), 2.3);
}

TEST_F(RenderTimerTest, NothingToMeasureIsNothing) {
  EXPECT_TRUE(measure({}, {}).empty());
}

TEST_F(RenderTimerTest, ProgressNeverFallsAndMayEndIt) {
  double last = 0;
  const std::vector<TestMesh> meshes = {test_meshes::cube(), test_meshes::geosphere(8)};
  measure(meshes,
          {.width = 32, .height = 32, .steps = 2, .budget_seconds = 0.1, .progress = [&](double fraction) {
             EXPECT_GE(fraction, last);
             EXPECT_LE(fraction, 1);
             last = fraction;
           }});
  struct Stop {};
  EXPECT_THROW(measure(meshes, {.progress = [](double) { throw Stop(); }}), Stop);
  EXPECT_EQ(measure(meshes, {.width = 32, .height = 32, .steps = 1, .budget_seconds = 0.01}).size(), 2U)
      << "the device is as good as before";
}

TEST_F(RenderTimerTest, AMeshThatDoesNotFitCostsOnlyItsOwnTime) {
  const std::vector<TestMesh> meshes = {test_meshes::cube(), test_meshes::geosphere(8),
                                        test_meshes::torus(8, 5)};
  const TimingOptions options{.width = 32, .height = 32, .steps = 1, .budget_seconds = 0.03};
  for (const std::uint32_t allocations : {2U, 3U, 4U, 5U}) {  // after the picture's two
    gpu::faults(device()).allocations_until_failure = allocations;
    for (const RenderingTime& time : measure(meshes, options)) {
      EXPECT_EQ(time.not_measured, "") << allocations << ": halves fit";
      EXPECT_GT(time.mean_ns, 0);
    }
  }
  gpu::faults(device()).allocations_until_failure = 2;
  const auto alone = measure({test_meshes::cube()}, options);
  EXPECT_THAT(alone.at(0).not_measured, HasSubstr("positions to draw"));
  EXPECT_EQ(alone.at(0).mean_ns, 0);
  gpu::faults(device()) = {};
}

TEST_F(RenderTimerTest, AClockThatRunsBackwardsIsSaidSo) {
  gpu::faults(device()).clock_runs_backwards = true;
  const auto times = measure({test_meshes::cube(), test_meshes::grid(2, 2)},
                             {.width = 32, .height = 32, .steps = 2, .budget_seconds = 0.2});
  gpu::faults(device()) = {};
  for (const RenderingTime& time : times) {
    EXPECT_THAT(time.not_measured, HasSubstr("backwards"));
    EXPECT_EQ(time.mean_ns, 0);
  }
}

TEST_F(RenderTimerTest, PicturesBeyondTheDeviceAreAnError) {
  EXPECT_THROW(measure({test_meshes::cube()}, {.width = 1'000'000}), gpu::Error);
}

TEST(WhyNot, NamesWhatTheDeviceLacks) {
  gpu::DeviceInfo device;
  device.name = "a compute card";
  device.timestamp_bits = 64;
  EXPECT_THAT(why_not(device), testing::AllOf(HasSubstr("a compute card"), HasSubstr("draw")));
  device.can_draw = true;
  EXPECT_EQ(why_not(device), "");
  device.timestamp_bits = 0;
  EXPECT_THAT(why_not(device), HasSubstr("timestamps"));
}

}  // namespace
}  // namespace scene_analyzer::render_timing
