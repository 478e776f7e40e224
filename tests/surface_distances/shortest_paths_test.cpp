#include "surface_distances/shortest_paths.h"

#include <gtest/gtest.h>

#include "surface_distances/surfaces.h"

namespace scene_analyzer::surface_distances {
namespace {

// A random graph with arcs both ways, connected by a path through all nodes.
template <typename Length>
DualGraph random_graph(std::uint32_t nodes, std::uint32_t extra, std::uint64_t seed, Length length) {
  test_meshes::Random random(seed);
  reference::SurfaceArcs arcs;
  arcs.from.resize(nodes);
  const auto any_node = [&] { return static_cast<std::uint32_t>(random.below(nodes)); };
  for (std::uint32_t v = 1; v < nodes; ++v) connect(arcs, v - 1, v, length(random));
  for (std::uint32_t i = 0; i < extra; ++i) {
    const std::uint32_t from = any_node(), to = any_node();
    connect(arcs, from, to, length(random));
  }
  return graph_of(arcs);
}

reference::SurfaceArcs arcs_of(const DualGraph& graph) {
  reference::SurfaceArcs arcs;
  arcs.from.resize(graph.nodes());
  for (std::uint32_t v = 0; v < graph.nodes(); ++v)
    for (std::uint32_t arc = graph.first[v]; arc < graph.first[v + 1]; ++arc)
      arcs.from[v].push_back({graph.target[arc], graph.length[arc]});
  return arcs;
}

void expect_dijkstra(const DualGraph& graph, const char* what) {
  const reference::SurfaceArcs arcs = arcs_of(graph);
  ShortestPaths paths(graph);
  std::vector<double> distances(graph.nodes());
  for (const std::uint32_t source : {0U, graph.nodes() / 2, graph.nodes() - 1}) {
    paths.run(source, distances);
    EXPECT_EQ(distances, reference::surface_distances(arcs, source)) << what << ", from " << source;
  }
}

TEST(ShortestPaths, AreBitIdenticalToDijkstra) {
  for (const std::uint32_t nodes : {1U, 2U, 3U, 63U, 1000U, 5000U}) {
    expect_dijkstra(random_graph(nodes, nodes, nodes, [](auto& random) { return random.unit(); }), "uniform");
    expect_dijkstra(random_graph(nodes, nodes, nodes, [](auto&) { return 1.0; }), "equal");
    expect_dijkstra(random_graph(nodes, nodes, nodes, [](auto&) { return 0.0; }), "zero");
  }
}

TEST(ShortestPaths, SurviveLengthsOfAllMagnitudes) {
  const auto wide = [](auto& random) { return std::pow(10.0, random.between(-300, 300)); };
  const auto tiny = [](auto& random) { return random.below(1000) == 0 ? 1e9 : random.unit() * 1e-9; };
  for (const std::uint64_t seed : {1, 2, 3}) {
    expect_dijkstra(random_graph(3000, 3000, seed, wide), "wide");
    expect_dijkstra(random_graph(3000, 3000, seed, tiny), "tiny");
  }
}

// Label correction visits nodes of this ladder exponentially often in the worst order; the heap must take
// over.
TEST(ShortestPaths, GiveUpBucketsThatVisitNodesTooOften) {
  constexpr std::uint32_t kSteps = 2000;
  reference::SurfaceArcs arcs;
  arcs.from.resize(2 * kSteps + 1);
  const auto lead = [&](std::uint32_t a, std::uint32_t b, double length) {
    arcs.from[a].push_back({b, length});
  };
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double step = 1e-6 * (kSteps - i);
    lead(2 * i, 2 * i + 2, step);
    lead(2 * i, 2 * i + 1, 0);
    lead(2 * i + 1, 2 * i + 2, step / 2);
  }
  lead(0, 2 * kSteps, 1e6);
  const DualGraph graph = graph_of(arcs);
  expect_dijkstra(graph, "ladder");
  ShortestPaths paths(graph);
  std::vector<double> distances(graph.nodes());
  paths.run(0, distances);
  EXPECT_TRUE(paths.uses_heap());
}

TEST(ShortestPaths, ChangeToTheHeapOnlyThen) {
  const DualGraph graph = random_graph(5000, 5000, 1, [](auto& random) { return random.unit(); });
  ShortestPaths paths(graph);
  std::vector<double> distances(graph.nodes());
  paths.run(0, distances);
  EXPECT_FALSE(paths.uses_heap());
}

}  // namespace
}  // namespace scene_analyzer::surface_distances
