// Welding, areas and totals on the device against the plain twin.
#include "geometry/geometry.h"

#include <gtest/gtest.h>

#include <limits>

#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::geometry {
namespace {

using test_meshes::TestMesh;

class GeometryTest : public test::GpuTest {
 protected:
  void compare(const TestMesh& mesh) {
    SCOPED_TRACE(mesh.name);
    const auto twin = reference::evaluate_stages(mesh);
    const Geometry geometry = test::measure_up_to_adjacency(device(), mesh).geometry;
    const auto corners = geometry.corners.download(device());
    for (std::size_t i = 0; i < corners.size(); ++i)
      ASSERT_EQ(corners[i], twin.representative[mesh.indices[i]]) << i;
    const auto areas = geometry.areas.download(device());
    for (std::size_t t = 0; t < areas.size(); ++t)
      ASSERT_NEAR(areas[t], twin.triangles.area[t], 1e-12 * twin.triangles.area[t]) << t;
    const auto totals = geometry.results(device()).front();
    EXPECT_EQ(totals.kept, twin.triangles.kept_count);
    EXPECT_EQ(totals.degenerate, mesh.triangle_count() - twin.triangles.kept_count);
    EXPECT_NEAR(totals.area, twin.triangles.surface_area, 1e-12 * twin.triangles.surface_area);
    EXPECT_EQ(totals.largest_coordinate, twin.triangles.largest_coordinate);
    if (!twin.triangles.bounds) return;
    EXPECT_EQ(totals.low, twin.triangles.bounds->min);
    EXPECT_EQ(totals.high, twin.triangles.bounds->max);
  }
};

TEST_F(GeometryTest, AgreesWithTheTwinOnTheCatalogue) {
  for (const TestMesh& mesh : test::measurable_meshes()) compare(mesh);
}

TEST_F(GeometryTest, AgreesWithTheTwinOnNastySizes) {
  for (const std::uint32_t size : test_meshes::nasty_sizes()) {
    compare(test_meshes::isolated_soup(size, size));
    compare(test_meshes::unwelded(test_meshes::grid(size, 1)));
  }
}

TEST_F(GeometryTest, SubnormalCoordinatesKeepTheirShape) {
  TestMesh tiny = test_meshes::scaled(test_meshes::cube(), 1e-40);
  compare(tiny);
}

TEST_F(GeometryTest, NegativeZeroIsZeroAndInfinityIsDropped) {
  compare(test_meshes::signed_zeros());
  TestMesh infinite = test_meshes::cube();
  infinite.positions[4] = std::numeric_limits<float>::infinity();
  compare(infinite);
}

TEST_F(GeometryTest, BatchLimitsLeaveRoomInHashTables) {
  gpu::DeviceInfo info;
  info.max_storage_buffer_bytes = std::uint64_t{128} << 20;
  const BatchLimits limits = batch_limits(info);
  EXPECT_GE(limits.triangles, 10'000'000U);
  EXPECT_GE(limits.vertices, 30'000'000U);
  EXPECT_LT(3 * limits.triangles, info.max_storage_buffer_bytes / 4);
  info.max_storage_buffer_bytes = std::uint64_t{1} << 40;
  EXPECT_LT(3 * batch_limits(info).triangles, std::uint64_t{1} << 31);
}

}  // namespace
}  // namespace scene_analyzer::geometry
