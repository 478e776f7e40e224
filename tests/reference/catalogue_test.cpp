// What must not change a mesh's results: order, winding, position of shared vertices, scale.
#include <gtest/gtest.h>

#include <set>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

void expect_same(const test_meshes::TestMesh& mesh, const test_meshes::TestMesh& variant, double alpha) {
  SCOPED_TRACE(mesh.name + " against " + variant.name);
  analysis::GeometryAnalysis a = evaluate(mesh, {.alpha_degrees = alpha, .dim = 300});
  analysis::GeometryAnalysis b = evaluate(variant, {.alpha_degrees = alpha, .dim = 300});
  EXPECT_EQ(a.source_triangles, b.source_triangles);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.planar_groups, b.planar_groups);
  EXPECT_EQ(a.largest_planar_group, b.largest_planar_group);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.isolated_triangles, b.isolated_triangles);
  EXPECT_EQ(a.non_manifold_edges, b.non_manifold_edges);
  EXPECT_EQ(a.boundary_edges, b.boundary_edges);
  EXPECT_EQ(a.area_classes, b.area_classes);
  EXPECT_EQ(a.polygons_per_planar_group, b.polygons_per_planar_group);
  EXPECT_EQ(a.planar_group_variation, b.planar_group_variation);
  EXPECT_NEAR(a.surface_area, b.surface_area, 1e-14 * a.surface_area);
  ASSERT_EQ(a.cooccurrence_contrast.has_value(), b.cooccurrence_contrast.has_value());
  EXPECT_NEAR(a.cooccurrence_contrast.value_or(0), b.cooccurrence_contrast.value_or(0), 1e-13);
}

TEST(Catalogue, IsSmallAndNamedUniquely) {
  std::set<std::string> names;
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    EXPECT_LE(mesh.triangle_count(), 5000U) << mesh.name;
    EXPECT_EQ(mesh.indices.size() % 3 + mesh.positions.size() % 3, 0U) << mesh.name;
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertex_count()) << mesh.name;
    EXPECT_TRUE(names.insert(mesh.name).second) << mesh.name;
  }
}

TEST(Catalogue, OrderDoesNotMatter) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    expect_same(mesh, test_meshes::shuffled(mesh, 5), 0);
    expect_same(mesh, test_meshes::shuffled(mesh, 6), 30);
  }
}

TEST(Catalogue, WindingDoesNotMatter) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue())
    expect_same(mesh, test_meshes::flipped(mesh, 5), 10);
}

TEST(Catalogue, SharingVerticesDoesNotMatter) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue())
    expect_same(mesh, test_meshes::unwelded(mesh), 10);
}

TEST(Catalogue, ScalingByPowersOfTwoChangesNoRating) {
  for (const test_meshes::TestMesh& mesh :
       {test_meshes::heightfield(20, 0.5, 9), test_meshes::lattice_soup(6, 2500, 2),
        test_meshes::torus(48, 24)}) {
    const analysis::GeometryAnalysis a = evaluate(mesh);
    const analysis::GeometryAnalysis b = evaluate(test_meshes::scaled(mesh, 0x1p40));
    EXPECT_EQ(a.planar_groups, b.planar_groups) << mesh.name;
    EXPECT_EQ(a.area_classes, b.area_classes) << mesh.name;
    EXPECT_EQ(a.cooccurrence_contrast, b.cooccurrence_contrast) << mesh.name;
  }
}

}  // namespace
}  // namespace scene_analyzer::reference
