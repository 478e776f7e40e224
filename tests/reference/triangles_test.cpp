#include "reference/triangles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/placement.h"
#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

TEST(Triangles, AreaHeightCentroidAndBounds) {
  const test_meshes::TestMesh mesh{"3-4-5", {1, 1, 0, 5, 1, 0, 1, 4, -7, 9, 9, 9, 1, 4, 0}, {0, 1, 4}};
  const TriangleMeasures measures = evaluate_stages(mesh).triangles;
  EXPECT_DOUBLE_EQ(measures.area[0], 6);
  EXPECT_DOUBLE_EQ(measures.height[0], 12.0 / 5);
  EXPECT_DOUBLE_EQ(measures.centroid[0][0], 7.0 / 3);
  EXPECT_DOUBLE_EQ(measures.centroid[0][1], 2);
  EXPECT_EQ(measures.largest_coordinate, 5);  // not the 9 of a vertex that no triangle uses
  ASSERT_TRUE(measures.bounds);
  EXPECT_EQ(measures.bounds->max, (std::array<float, 3>{5, 4, 0}));
}

TEST(Triangles, LinearPartIsAppliedFirst) {
  const test_meshes::TestMesh mesh = test_meshes::single_triangle();
  const Evaluation stages = evaluate_stages(mesh.positions, mesh.indices, {2, 0, 0, 0, 3, 0, 0, 0, 1});
  EXPECT_DOUBLE_EQ(stages.triangles.area[0], 3);
  EXPECT_EQ(stages.triangles.largest_coordinate, 3);
  const Evaluation flat = evaluate_stages(mesh.positions, mesh.indices, {1, 0, 0, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(flat.triangles.kept_count, 0U);
}

TEST(Triangles, DegenerateOnesAreLeftOut) {
  const Evaluation stages = evaluate_stages(test_meshes::all_degenerate());
  EXPECT_EQ(stages.triangles.kept_count, 0U);
  EXPECT_FALSE(stages.triangles.bounds);
  const auto kept = [](float height) {
    return evaluate({"sliver", {0, 0, 0, 2, 0, 0, 1, height, 0}, {0, 1, 2}}).triangles;
  };
  EXPECT_EQ(kept(2.1e-6F), 1U);
  EXPECT_EQ(kept(1.9e-6F), 0U);
}

TEST(Triangles, NonFiniteCornersDropTheirTriangles) {
  const test_meshes::TestMesh mesh = test_meshes::non_finite(1);
  const Evaluation stages = evaluate_stages(mesh);
  std::uint64_t expected = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    bool finite = true;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t axis = 0; axis < 3; ++axis)
        finite = finite && std::isfinite(mesh.positions[3 * std::size_t{mesh.indices[3 * t + c]} + axis]);
    expected += finite ? 1 : 0;
  }
  EXPECT_EQ(stages.triangles.kept_count, expected);
  EXPECT_LT(expected, mesh.triangle_count());
  EXPECT_TRUE(std::isfinite(stages.triangles.surface_area));
}

TEST(Placement, SimilaritiesKeepFileCoordinates) {
  const Placement turned = placement_of({0, -3, 0, 5, 3, 0, 0, 5, 0, 0, -3, 5, 0, 0, 0, 1});
  EXPECT_EQ(turned.linear, mesh::kIdentity3);
  EXPECT_DOUBLE_EQ(turned.area_scale, 9);
  const Placement stretched = placement_of({1, 0, 0, 5, 0, 1.001, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1});
  EXPECT_EQ(stretched.linear, (mesh::Matrix3{1, 0, 0, 0, 1.001, 0, 0, 0, 1}));
  EXPECT_EQ(stretched.area_scale, 1);
}

TEST(Placement, WorldBoundsAreThoseOfKeptTriangles) {
  test_meshes::TestMesh mesh = test_meshes::cube();
  mesh.vertex(50, 50, 50);
  mesh.triangle(0, 0, 8);
  const Evaluation stages = evaluate_stages(mesh);
  const auto bounds = world_bounds(geometry_of(mesh, stages), stages.triangles,
                                   {2, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1});
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->min, (mesh::Vector3{1, -1, 0}));
  EXPECT_EQ(bounds->max, (mesh::Vector3{3, 0, 1}));
}

}  // namespace
}  // namespace scene_analyzer::reference
