#include "reference/adjacency.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

TEST(Adjacency, ClosedOpenAndTwistedSurfaces) {
  const Adjacency cube = evaluate_stages(test_meshes::cube()).adjacency;
  EXPECT_EQ(cube.edge_count(), 18U);
  EXPECT_EQ(cube.boundary_edges, 0U);
  EXPECT_EQ(cube.components, 1U);
  const Adjacency grid = evaluate_stages(test_meshes::grid(4, 4)).adjacency;
  EXPECT_EQ(grid.boundary_edges, 16U);
  EXPECT_EQ(grid.edge_count(), 56U);
  EXPECT_EQ(evaluate_stages(test_meshes::mobius_strip(60)).adjacency.boundary_edges, 120U);
  const Adjacency klein = evaluate_stages(test_meshes::klein_bottle(40, 24)).adjacency;
  EXPECT_EQ(klein.boundary_edges + klein.non_manifold_edges, 0U);
  EXPECT_EQ(klein.edge_count(), 3U * 40 * 24);
}

TEST(Adjacency, EveryPageOfABookNeighboursAllOthers) {
  const Adjacency book = evaluate_stages(test_meshes::book(200, 3)).adjacency;
  EXPECT_EQ(book.non_manifold_edges, 1U);
  EXPECT_EQ(book.boundary_edges, 400U);
  for (const std::uint32_t neighbours : book.neighbours) EXPECT_EQ(neighbours, 199U);
}

TEST(Adjacency, ComponentsAndIsolatedTriangles) {
  const analysis::GeometryAnalysis soup = evaluate(test_meshes::isolated_soup(500, 1));
  EXPECT_EQ(soup.components, 500U);
  EXPECT_EQ(soup.isolated_triangles, 500U);
  EXPECT_EQ(evaluate(test_meshes::signed_zeros()).isolated_triangles, 0U);
  const analysis::GeometryAnalysis parts = evaluate(test_meshes::spread(
      "parts", {test_meshes::cube(), test_meshes::geosphere(3), test_meshes::single_triangle()}, 10));
  EXPECT_EQ(parts.components, 3U);
  EXPECT_EQ(parts.isolated_triangles, 1U);
}

// Bucketed sorting against a map, and components against flooding.
TEST(Adjacency, AgreesWithAMapOfEdges) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const Evaluation stages = evaluate_stages(mesh);
    const Geometry geometry = geometry_of(mesh, stages);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
    for (std::uint32_t h = 0; h < mesh.indices.size(); ++h)
      if (stages.triangles.kept[h / 3])
        expected[std::minmax(geometry.half_edge_from(h), geometry.half_edge_to(h))].push_back(h);
    ASSERT_EQ(stages.adjacency.edge_count(), expected.size()) << mesh.name;
    std::size_t e = 0;
    for (const auto& [key, half_edges] : expected) {
      const std::span<const std::uint32_t> edge = stages.adjacency.edge(e++);
      ASSERT_EQ(std::vector<std::uint32_t>(edge.begin(), edge.end()), half_edges) << mesh.name;
      for (const std::uint32_t h : half_edges)
        ASSERT_EQ(stages.adjacency.component[h / 3], stages.adjacency.component[half_edges[0] / 3])
            << mesh.name;
    }
    std::set<std::uint32_t> labels(stages.adjacency.component.begin(), stages.adjacency.component.end());
    labels.erase(kNone);
    EXPECT_EQ(labels.size(), stages.adjacency.components) << mesh.name;
  }
}

}  // namespace
}  // namespace scene_analyzer::reference
