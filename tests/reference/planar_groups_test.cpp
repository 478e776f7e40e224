#include "reference/planar_groups.h"

#include <gtest/gtest.h>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

std::uint64_t groups(const test_meshes::TestMesh& mesh, double alpha = 0) {
  return *evaluate(mesh, {.alpha_degrees = alpha}).planar_groups;
}

TEST(PlanarGroups, AngleLimitIncludesAlphaAndTolerance) {
  EXPECT_EQ(groups(test_meshes::two_triangles(0.009)), 1U);
  EXPECT_EQ(groups(test_meshes::two_triangles(0.011)), 2U);
  EXPECT_EQ(groups(test_meshes::two_triangles(30), 29.98), 2U);
  EXPECT_EQ(groups(test_meshes::two_triangles(30), 30), 1U);
  EXPECT_EQ(groups(test_meshes::two_triangles(180), 179.9), 2U);
  EXPECT_EQ(groups(test_meshes::two_triangles(180), 180), 1U);
}

TEST(PlanarGroups, CoarseCoordinatesWidenTheTolerance) {
  // 1e6 away a float step is 0.06: the quarter-unit grid is exact and stays one plane, slightly tilted facets
  // join.
  EXPECT_EQ(groups(test_meshes::moved(test_meshes::grid(20, 20, 0.25), 1e6, 0, 0)), 1U);
  EXPECT_EQ(groups(test_meshes::two_triangles(0.5)), 2U);
  EXPECT_EQ(groups(test_meshes::moved(test_meshes::two_triangles(0.5), 1e5, 0, 0)), 1U);
}

TEST(PlanarGroups, BookOfFewPlanesHasOneGroupPerPlane) {
  // In half-planes at k quarter turns, opposite ones are one plane. Coinciding pages lie folded back on each
  // other: 180 degrees apart, and joined only through the opposite side.
  const analysis::GeometryAnalysis book = evaluate(test_meshes::book(400, 2, 4));
  EXPECT_EQ(book.planar_groups, 2U);
  EXPECT_EQ(evaluate(test_meshes::book(300, 2, 7)).planar_groups, 300U);
  EXPECT_EQ(groups(test_meshes::book(300, 2, 7), 180), 1U);
}

TEST(PlanarGroups, AgreesWithAllPairs) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const Evaluation stages = evaluate_stages(mesh);
    const Geometry geometry = geometry_of(mesh, stages);
    for (const double alpha : {0.0, 1.0, 20.0, 89.0, 91.0, 135.0, 179.995, 180.0}) {
      const PlanarGroups fast = planar_groups(geometry, stages.triangles, stages.adjacency, alpha);
      const PlanarGroups slow = planar_groups_all_pairs(geometry, stages.triangles, stages.adjacency, alpha);
      EXPECT_EQ(fast.group, slow.group) << mesh.name << " alpha " << alpha;
      EXPECT_EQ(fast.count, slow.count) << mesh.name << " alpha " << alpha;
    }
  }
}

TEST(PlanarGroups, WindingDoesNotMatter) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const test_meshes::TestMesh flipped = test_meshes::flipped(mesh, 77);
    for (const double alpha : {0.0, 25.0, 100.0})
      EXPECT_EQ(evaluate_stages(mesh, {.alpha_degrees = alpha}).groups.group,
                evaluate_stages(flipped, {.alpha_degrees = alpha}).groups.group)
          << mesh.name << " alpha " << alpha;
  }
}

TEST(PlanarGroups, MillionTrianglesOnOneEdge) {
  const analysis::GeometryAnalysis book = evaluate(test_meshes::book(1'000'000, 1));
  EXPECT_EQ(book.triangles, 1'000'000U);
  EXPECT_EQ(book.non_manifold_edges, 1U);
  EXPECT_EQ(book.planar_groups, 1U);  // directions are closer than the tolerance all around
}

}  // namespace
}  // namespace scene_analyzer::reference
