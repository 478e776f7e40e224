// The printed values of the specification's table of reference values.
#include "reference/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

constexpr double kPrinted = 5e-6;

TEST(ReferenceValues, PolygonsPerPlanarGroup) {
  const analysis::GeometryAnalysis geosphere = evaluate(test_meshes::geosphere(4));
  EXPECT_EQ(geosphere.triangles, 320U);
  EXPECT_EQ(geosphere.planar_groups, 320U);
  EXPECT_EQ(geosphere.polygons_per_planar_group, 0);
  const analysis::GeometryAnalysis cube = evaluate(test_meshes::cube());
  EXPECT_EQ(cube.planar_groups, 6U);
  EXPECT_DOUBLE_EQ(*cube.polygons_per_planar_group, 6.0 / 11);
  const analysis::GeometryAnalysis prism = evaluate(test_meshes::prism(6, 5, 1, 3));
  EXPECT_EQ(prism.triangles, 72U);
  EXPECT_EQ(prism.planar_groups, 8U);
  EXPECT_DOUBLE_EQ(*prism.polygons_per_planar_group, 64.0 / 71);
}

TEST(ReferenceValues, GeospheresWithFewCoplanarTriangles) {
  const auto check = [](const test_meshes::TestMesh& mesh, std::uint64_t triangles, std::uint64_t groups,
                        double rating) {
    const analysis::GeometryAnalysis result = evaluate(mesh);
    EXPECT_EQ(result.triangles, triangles);
    EXPECT_EQ(result.planar_groups, groups);
    EXPECT_EQ(result.components, 1U);
    EXPECT_EQ(result.boundary_edges, 0U);
    EXPECT_NEAR(*result.polygons_per_planar_group, rating, 5e-6);
  };
  check(test_meshes::geosphere(20), 8000, 8000, 0);
  check(test_meshes::geosphere_8006(), 8006, 8002, 0.0005);
  check(test_meshes::geosphere_8010(), 8010, 8005, 0.00062);
}

TEST(ReferenceValues, PlanarGroupVariation) {
  EXPECT_EQ(evaluate(test_meshes::split_tetrahedron(0)).planar_group_variation, 0);
  EXPECT_DOUBLE_EQ(*evaluate(test_meshes::split_tetrahedron(1)).planar_group_variation, 0.5);
  const analysis::GeometryAnalysis split = evaluate(test_meshes::split_tetrahedron(3));
  EXPECT_EQ(split.triangles, 30U);
  EXPECT_EQ(split.largest_planar_group, 27U);
  EXPECT_DOUBLE_EQ(*split.planar_group_variation, 0.9);
}

TEST(ReferenceValues, CooccurrenceContrastOfTubes) {
  for (const auto& [split, triangles, rating] : {std::tuple{0, 8U, 0.0}, {1, 12U, 0.53303}, {2, 16U, 1.0}}) {
    const Evaluation tube = evaluate_stages(test_meshes::four_sided_tube(split));
    EXPECT_EQ(tube.triangles.kept_count, triangles);
    EXPECT_NEAR(tube.contrast.rating, rating, kPrinted);
    const std::vector<double> printed = split == 0   ? std::vector{35.3553}
                                        : split == 1 ? std::vector{7.6778, 27.6776, 35.3553}
                                                     : std::vector{7.6778, 27.6776};
    EXPECT_THAT(tube.classes.value, testing::Pointwise(testing::DoubleNear(5e-5), printed));
  }
}

TEST(ReferenceValues, FurnitureLeg) {
  for (const double height : {0.12, 0.4}) {
    const analysis::GeometryAnalysis leg = evaluate(test_meshes::prism(10, 1, 0.03, height));
    EXPECT_EQ(leg.triangles, 40U);
    EXPECT_EQ(leg.planar_groups, 12U);
    EXPECT_NEAR(*leg.polygons_per_planar_group, 0.717949, kPrinted);
    EXPECT_NEAR(*leg.planar_group_variation, 0.387298, kPrinted);
    EXPECT_NEAR(*leg.cooccurrence_contrast, 1.0 / 3, kPrinted);
  }
}

TEST(ReferenceValues, FlatGrid) {
  const analysis::GeometryAnalysis grid = evaluate(test_meshes::grid(4, 4));
  EXPECT_EQ(grid.triangles, 32U);
  EXPECT_EQ(grid.polygons_per_planar_group, 1);
  EXPECT_EQ(grid.planar_group_variation, 1);
  EXPECT_EQ(grid.cooccurrence_contrast, 0);
  EXPECT_EQ(grid.area_classes, 1U);
}

TEST(Evaluate, SmallestMeshes) {
  const analysis::GeometryAnalysis single = evaluate(test_meshes::single_triangle());
  EXPECT_EQ(single.polygons_per_planar_group, 0);
  EXPECT_EQ(single.planar_group_variation, 0);
  EXPECT_EQ(single.cooccurrence_contrast, 0);
  EXPECT_EQ(single.isolated_triangles, 1U);
  const analysis::GeometryAnalysis none = evaluate(test_meshes::all_degenerate());
  EXPECT_EQ(none.degenerate_triangles, none.source_triangles);
  EXPECT_GT(none.source_triangles, 0U);
  EXPECT_FALSE(none.polygons_per_planar_group);
  EXPECT_FALSE(none.planar_group_variation);
  EXPECT_FALSE(none.cooccurrence_contrast);
}

TEST(Evaluate, WeldToleranceClosesGaps) {
  const test_meshes::TestMesh gap{
      "gap", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1e-4F, 0, 0, 1e-4F, 0.4F, -1, 0}, {0, 1, 2, 3, 4, 5}};
  EXPECT_EQ(evaluate(gap).isolated_triangles, 2U);
  EXPECT_EQ(evaluate(gap, {.weld_tolerance = 1e-3}).isolated_triangles, 0U);
}

}  // namespace
}  // namespace scene_analyzer::reference
