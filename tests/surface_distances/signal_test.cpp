#include "surface_distances/signal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface_distances/start_triangle.h"
#include "surface_distances/surfaces.h"

namespace scene_analyzer::surface_distances {
namespace {

using SignalTest = SurfaceTest;

// Signals of equal shape, compared value by value within rounding.
void expect_signal(const Signal& signal, const reference::SurfaceSignal& expected, const std::string& what) {
  const std::vector<double> values = expected.values();
  ASSERT_EQ(signal.areas.size(), values.size()) << what;
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_NEAR(signal.areas[i], values[i], 2e-9 * std::abs(values[i])) << what << ", " << i;
  EXPECT_EQ(signal.gap, 0) << what;
  if (values.empty()) return;
  const auto& first = expected.components.front();
  EXPECT_NEAR(signal.mean_distance * static_cast<double>(first.signal.size() - 1), first.total_distance,
              1e-9 * first.total_distance)
      << what;
}

TEST_F(SignalTest, IsTheTwinsOnTheWholeCatalogue) {
  for (const auto& mesh : test::measurable_meshes()) {
    if (mesh.triangle_count() > 2500) continue;  // all pairs take too long
    const TwinSurface twin(mesh);
    const auto expected = reference::surface_signal(twin.stages.triangles, twin.stages.adjacency, twin.arcs);
    const Measured measured = measure(mesh);
    const MeshSurface surface = measured.surface();
    const Signal signal = measure_signals(std::span(&surface, 1)).front();
    expect_signal(signal, expected, mesh.name);
    if (expected.components.size() == 1) {
      EXPECT_EQ(signal.start_triangle, expected.components.front().start) << mesh.name;
    }
  }
}

TEST_F(SignalTest, ForgetsTheOrderOfTheFile) {
  for (const auto& mesh :
       {test_meshes::geosphere(6), test_meshes::torus(24, 14), test_meshes::heightfield(15, 1, 9),
        test_meshes::spread("two", {test_meshes::cube(), test_meshes::prism(9, 3, 1, 2)}, 5)}) {
    const Measured plain = measure(mesh);
    const MeshSurface surface = plain.surface();
    const Signal expected = measure_signals(std::span(&surface, 1)).front();
    for (const std::uint64_t seed : {1, 2, 3}) {
      const auto other = test_meshes::shuffled(mesh, seed);
      const Measured measured = measure(other);
      const MeshSurface shuffled = measured.surface();
      const Signal signal = measure_signals(std::span(&shuffled, 1)).front();
      ASSERT_EQ(signal.areas.size(), expected.areas.size());
      for (std::size_t i = 0; i < signal.areas.size(); ++i)
        ASSERT_NEAR(signal.areas[i], expected.areas[i], 2e-9 * expected.areas[i]) << mesh.name << ", " << i;
    }
  }
}

TEST_F(SignalTest, DoesNotDependOnTheNumberOfThreads) {
  std::vector<test_meshes::TestMesh> meshes = {test_meshes::geosphere(35),
                                               test_meshes::heightfield(30, 1, 2)};
  for (std::uint32_t i = 0; i < 40; ++i) meshes.push_back(test_meshes::prism(3 + i, 2, 1, 2));
  std::vector<Measured> measured;
  for (const auto& mesh : meshes) measured.push_back(measure(mesh));
  std::vector<MeshSurface> surfaces;
  for (const Measured& one : measured) surfaces.push_back(one.surface());
  const auto one = measure_signals(surfaces, {.threads = 1}),
             many = measure_signals(surfaces, {.threads = 5});
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].areas, many[i].areas) << meshes[i].name;
    EXPECT_EQ(one[i].searches, many[i].searches) << meshes[i].name;
    EXPECT_EQ(one[i].start_triangle, many[i].start_triangle) << meshes[i].name;
  }
}

TEST_F(SignalTest, LeavesOutWhatHasNoNeighbour) {
  const auto soup = test_meshes::isolated_soup(50, 1);
  const Measured measured = measure(soup);
  const MeshSurface surface = measured.surface();
  const Signal signal = measure_signals(std::span(&surface, 1)).front();
  EXPECT_TRUE(signal.areas.empty());
  EXPECT_EQ(signal.searches, 0);
}

// The leg of the specification: 40 triangles, R_ft 0.09168 at height 0.12 and 0.13315 at height 0.4.
TEST_F(SignalTest, GivesTheFurnitureLegsRatings) {
  for (const auto& [height, rating] : {std::pair(0.12, 0.09168), std::pair(0.4, 0.13315)}) {
    const auto leg = test_meshes::prism(10, 1, 0.03, height);
    const Measured measured = measure(leg);
    const MeshSurface surface = measured.surface();
    const Signal signal = measure_signals(std::span(&surface, 1)).front();
    ASSERT_EQ(signal.areas.size(), 40);
    EXPECT_NEAR(reference::fourier_rating(signal.areas), rating, 0.5e-5) << height;
  }
}

TEST_F(SignalTest, CanBeCancelled) {
  const auto mesh = test_meshes::torus(24, 14);
  const Measured measured = measure(mesh);
  const MeshSurface surface = measured.surface();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(measure_signals(std::span(&surface, 1), {.stop = stop.get_token()}), Cancelled);
}

TEST(FourierRating, OfTheSpecificationsSignals) {
  EXPECT_NEAR(reference::fourier_rating(std::vector<double>(6, 100)), 0, 1e-12);
  EXPECT_NEAR(reference::fourier_rating(std::vector<double>{200, 100, 100, 100, 100, 100}), 0.095238095,
              5e-10);
  EXPECT_NEAR(reference::fourier_rating(std::vector<double>{100, 1}), 0.98019802, 5e-9);
  EXPECT_NEAR(reference::fourier_rating(std::vector<double>{1000, 100, 100, 100}), 0.519230769, 5e-10);
}

}  // namespace
}  // namespace scene_analyzer::surface_distances
