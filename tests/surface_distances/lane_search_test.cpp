// Many searches at once find what single ones find, in doubles and in whole units.
#include "surface_distances/lane_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface_distances/surfaces.h"

namespace scene_analyzer::surface_distances {
namespace {

std::vector<test_meshes::TestMesh> meshes() {
  return {test_meshes::geosphere(9), test_meshes::torus(31, 17), test_meshes::heightfield(20, 1, 4),
          test_meshes::shuffled(test_meshes::prism(20, 12, 1, 3), 5)};
}

struct Ordered {
  TwinSurface twin;
  DualGraph graph;
  std::vector<double> distances;  // from node 5
  explicit Ordered(const test_meshes::TestMesh& mesh)
      : twin(mesh), graph(graph_of(twin)), distances(graph.nodes()) {
    ShortestPaths(graph).run(5, distances);
  }
  double extent() const { return *std::ranges::max_element(distances); }
};

std::vector<std::uint32_t> random_nodes(std::size_t count, std::uint32_t below, test_meshes::Random& random) {
  std::vector<std::uint32_t> nodes;
  while (nodes.size() < count) nodes.push_back(static_cast<std::uint32_t>(random.below(below)));
  return nodes;
}

std::vector<std::uint32_t> rows_of(const std::vector<std::uint32_t>& nodes,
                                   const std::vector<std::uint32_t>& row) {
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t node : nodes) rows.push_back(row[node]);
  return rows;
}

TEST(LaneSearch, IsBitIdenticalToDijkstraInEveryLane) {
  for (const auto& mesh : meshes()) {
    const Ordered ordered(mesh);
    std::vector<std::uint32_t> row;
    const auto rows = order_by_distance<double>(ordered.graph, {ordered.distances, 1}, 1, row);
    LaneSearch<double> search;
    test_meshes::Random random(7);
    for (const std::size_t sources : {1U, 2U, 15U, 16U}) {
      const auto nodes = random_nodes(sources, ordered.graph.nodes(), random);
      for (const std::uint32_t near : {0U, 100U, ordered.graph.nodes()}) {
        search.run(rows, rows_of(nodes, row), near);
        const auto totals = search.totals(rows);
        for (std::size_t lane = 0; lane < sources; ++lane) {
          const auto expected = reference::surface_distances(ordered.twin.arcs, nodes[lane]);
          for (std::uint32_t v = 0; v < ordered.graph.nodes(); ++v)
            ASSERT_EQ(search.distances()[row[v]].of[lane], expected[v]) << mesh.name << ", near " << near;
          EXPECT_NEAR(totals[lane], reference::total_distance(ordered.twin.arcs, nodes[lane]),
                      1e-12 * totals[lane]);
        }
      }
    }
  }
}

TEST(LaneSearch, InUnitsIsNeverTooShortAndHardlyTooLong) {
  for (const auto& mesh : meshes()) {
    const Ordered ordered(mesh);
    const double unit = 4 * ordered.extent() / kUnreached<Units>;
    std::vector<std::uint32_t> row;
    for (const double radius : {0.0, 0.1, 10.0}) {
      const auto rows = order_by_distance<Units>(ordered.graph, {ordered.distances, radius}, unit, row);
      test_meshes::Random random(8);
      const auto nodes = random_nodes(kLanes, ordered.graph.nodes(), random);
      LaneSearch<Units> search;
      search.run(rows, rows_of(nodes, row), 50);
      const auto totals = search.totals(rows);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto expected = reference::surface_distances(ordered.twin.arcs, nodes[lane]);
        double total = 0;
        for (std::uint32_t v = 0; v < ordered.graph.nodes(); ++v) {
          const double found = search.distances()[row[v]].of[lane] * unit;
          ASSERT_GE(found, expected[v] * (1 - 1e-12)) << mesh.name;
          ASSERT_LE(found, expected[v] + unit * ordered.graph.triangles) << mesh.name;
          total += v < ordered.graph.triangles ? found : 0;
        }
        EXPECT_NEAR(totals[lane] * unit, total, 1e-12 * total);
      }
    }
  }
}

// Ways that whole units cannot count make no bound, rather than one that is too low.
TEST(LaneSearch, SaysWhereUnitsDoNotReach) {
  const Ordered ordered(test_meshes::torus(31, 17));
  std::vector<std::uint32_t> row;
  const double unit = ordered.extent() / kUnreached<Units>;
  const auto rows = order_by_distance<Units>(ordered.graph, {ordered.distances, 1}, unit, row);
  LaneSearch<Units> search;
  const std::vector<std::uint32_t> nodes{5, 0};  // from 5 the farthest is as far as can be, and rounded up
  search.run(rows, rows_of(nodes, row), 0);
  EXPECT_TRUE(std::isinf(search.totals(rows)[0]));
  const auto coarse = order_by_distance<Units>(ordered.graph, {ordered.distances, 1}, 4 * unit, row);
  search.run(coarse, rows_of(nodes, row), 0);
  EXPECT_FALSE(std::isinf(search.totals(coarse)[0]));
  const auto fine = order_by_distance<Units>(ordered.graph, {ordered.distances, 1}, unit * 1e-6, row);
  search.run(fine, rows_of(nodes, row), 0);
  EXPECT_TRUE(std::isinf(search.totals(fine)[0]));
  EXPECT_TRUE(std::isinf(search.totals(fine)[1]));
}

// Sources all over a lattice have no order of rows in common.
TEST(LaneSearch, GivesUpSearchingTogetherWhatHasNothingInCommon) {
  const Ordered ordered(test_meshes::torus(120, 60));
  std::vector<std::uint32_t> row;
  const auto rows = order_by_distance<double>(ordered.graph, {ordered.distances, 0}, 1, row);
  test_meshes::Random random(9);
  const auto nodes = random_nodes(kLanes, ordered.graph.nodes(), random);
  LaneSearch<double> search;
  EXPECT_FALSE(search.try_together(rows, rows_of(nodes, row), 0));
  search.run(rows, rows_of(nodes, row), 0);
  for (std::size_t lane = 0; lane < kLanes; lane += 5) {
    const auto expected = reference::surface_distances(ordered.twin.arcs, nodes[lane]);
    for (std::uint32_t v = 0; v < ordered.graph.nodes(); ++v)
      ASSERT_EQ(search.distances()[row[v]].of[lane], expected[v]);
  }
  EXPECT_TRUE(search.try_together(rows, rows_of({5}, row), 0)) << "nothing is left of the search given up";
  for (std::uint32_t v = 0; v < ordered.graph.nodes(); ++v)
    ASSERT_EQ(search.distances()[row[v]].of[0], ordered.distances[v]);
}

TEST(LaneGraph, IsInTheOrderOfDistancesInWholeBands) {
  for (const auto& mesh : meshes()) {
    const Ordered ordered(mesh);
    std::vector<std::uint32_t> row;
    const auto rows = order_by_distance<Units>(ordered.graph, {ordered.distances, 0.3}, 1e-6, row);
    EXPECT_EQ(rows.bands.front(), 0U);
    EXPECT_TRUE(std::ranges::is_sorted(rows.bands));
    EXPECT_EQ(rows.bands.back(), (rows.rows() + 63) / 64 * 64);
    for (const std::uint32_t band : rows.bands) EXPECT_EQ(band % 64, 0U);
    std::vector<double> by_row(rows.rows());
    for (std::uint32_t v = 0; v < rows.rows(); ++v) by_row[row[v]] = ordered.distances[v];
    const double one_class = ordered.extent() / (rows.rows() - 1);
    for (std::uint32_t i = 1; i < rows.rows(); ++i) EXPECT_GE(by_row[i], by_row[i - 1] - one_class);
  }
}

}  // namespace
}  // namespace scene_analyzer::surface_distances
