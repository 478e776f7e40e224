// Upper bounds are what the proof rests on: none may ever be below the true total.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "surface_distances/contraction.h"
#include "surface_distances/patch_bounds.h"
#include "surface_distances/start_triangle.h"
#include "surface_distances/surfaces.h"

namespace scene_analyzer::surface_distances {
namespace {

std::vector<test_meshes::TestMesh> meshes() {
  return {test_meshes::geosphere(8),
          test_meshes::torus(36, 20),
          test_meshes::grid(25, 20),
          test_meshes::heightfield(22, 1, 3),
          test_meshes::prism(24, 14, 1, 2),
          test_meshes::mobius_strip(300),
          test_meshes::klein_bottle(30, 20),
          test_meshes::book(300, 4),
          test_meshes::cone_fan(700),
          test_meshes::split_geosphere(9, 9, 9),
          test_meshes::shuffled(test_meshes::torus(30, 24), 3)};
}

std::vector<double> all_totals(const TwinSurface& twin) {
  std::vector<double> totals;
  for (std::uint32_t t = 0; t < twin.arcs.from.size(); ++t)
    totals.push_back(reference::total_distance(twin.arcs, t));
  return totals;
}

TEST(Contraction, NeverShortensAndKeepsTheMass) {
  for (const auto& mesh : meshes()) {
    const TwinSurface twin(mesh);
    const DualGraph graph = graph_of(twin);
    std::vector<double> distances(graph.nodes());
    ShortestPaths(graph).run(0, distances);
    std::vector<std::uint32_t> row;
    const LaneGraph rows = order_by_distance(graph, distances, row);
    std::vector<std::uint32_t> near(graph.nodes());
    std::ranges::copy(numbers_up_to(graph.nodes()), near.begin());
    std::ranges::sort(near, {}, [&](std::uint32_t v) { return distances[v]; });
    std::vector<std::uint32_t> sources, kept;
    for (std::size_t i = 0; i < 16; ++i) sources.push_back(row[near[3 * i]]);
    for (std::size_t i = 0; i < 60; ++i) kept.push_back(row[near[i]]);
    LaneSearch search;
    search.run(rows, sources, 0);
    for (const double tolerance : {0.0, 0.05 * distances[near.back()]}) {
      const Contraction smaller = contract(
          rows, search.distances(),
          {.kept_rows = kept, .centre_lane = 0, .kept_radius = distances[near[60]], .tolerance = tolerance});
      double mass = 0;
      for (const double m : smaller.graph.mass) mass += m;
      EXPECT_EQ(mass, graph.triangles) << mesh.name;
      EXPECT_LE(smaller.graph.rows(), rows.rows()) << mesh.name;
      std::vector<std::uint32_t> again;
      for (const std::uint32_t source : sources) again.push_back(smaller.row[source]);
      LaneSearch bounded;
      bounded.run(smaller.graph, again, 0);
      const auto bounds = bounded.totals(smaller.graph), totals = search.totals(rows);
      for (std::size_t lane = 0; lane < 16; ++lane) {
        EXPECT_GE(bounds[lane], totals[lane] * (1 - 1e-12)) << mesh.name;
        if (tolerance == 0) {
          EXPECT_LE(bounds[lane], totals[lane] * (1 + 1e-9)) << mesh.name;
        }
      }
    }
  }
}

TEST(PatchBounds, AreNeverBelowTheTruth) {
  for (const auto& mesh : meshes()) {
    const TwinSurface twin(mesh);
    const DualGraph graph = graph_of(twin);
    const std::vector<double> truth = all_totals(twin);
    Candidates candidates(graph.triangles);
    std::vector<double> distances(graph.nodes());
    ShortestPaths paths(graph);
    for (std::uint32_t source = 0; source < kLandmarks; ++source) {
      paths.run(source * graph.triangles / kLandmarks, distances);
      candidates.set_total(source * graph.triangles / kLandmarks, total_distance(graph, distances));
      candidates.bound_all(total_distance(graph, distances), distances);
    }
    std::vector<std::uint32_t> patch;
    for (const std::uint32_t v : candidates.open()) patch.push_back(v);
    for (const std::size_t size : {std::size_t{7}, std::size_t{100}, patch.size()}) {
      const std::vector<std::uint32_t> part(
          patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(std::min(size, patch.size())));
      if (part.empty()) continue;
      const PatchResult result = PatchBounder(graph).bound(part, candidates);
      EXPECT_EQ(result.totals.size() + result.bounds.size(), part.size()) << mesh.name;
      for (const auto& [v, total] : result.totals)
        EXPECT_NEAR(total, truth[v], 1e-12 * truth[v]) << mesh.name;
      for (const auto& [v, bound] : result.bounds) EXPECT_GE(bound, truth[v] * (1 - 1e-12)) << mesh.name;
    }
  }
}

StartTriangle start_of(const TwinSurface& twin, const StartSearchOptions& options = {}) {
  const DualGraph graph = graph_of(twin);
  return find_start_triangle(graph, twin.stages.triangles.area, numbers_up_to(graph.triangles), options);
}

TEST(StartTriangle, IsThatOfAllPairs) {
  for (const auto& mesh : meshes()) {
    const TwinSurface twin(mesh);
    const auto expected = reference::surface_signal(twin.stages.triangles, twin.stages.adjacency, twin.arcs);
    const StartTriangle start = start_of(twin);
    EXPECT_EQ(start.node, expected.components[0].start) << mesh.name;
    EXPECT_NEAR(start.total_distance, expected.components[0].total_distance, 1e-11 * start.total_distance)
        << mesh.name;
    EXPECT_EQ(start.gap, 0) << mesh.name;
  }
}

TEST(StartTriangle, DoesNotDependOnTheNumberOfThreads) {
  const TwinSurface twin(test_meshes::torus(60, 40));
  const StartTriangle one = start_of(twin, {.threads = 1});
  const StartTriangle many = start_of(twin, {.threads = 7});
  EXPECT_EQ(one.node, many.node);
  EXPECT_EQ(one.total_distance, many.total_distance);
  EXPECT_EQ(one.searches, many.searches);
}

TEST(StartTriangle, EndsEarlyWithAGapThatHolds) {
  for (const auto& mesh : meshes()) {
    const TwinSurface twin(mesh);
    const std::vector<double> truth = all_totals(twin);
    const double highest = *std::ranges::max_element(truth);
    for (const std::uint64_t most : {1U, 3U, 20U, 60U}) {
      const StartTriangle start = start_of(twin, {.most_searches = most});
      EXPECT_LE(highest, start.total_distance * (1 + start.gap) * (1 + 1e-9)) << mesh.name << ", " << most;
      EXPECT_NEAR(start.total_distance, truth[start.node], 1e-11 * highest) << mesh.name;
      const StartTriangle again = start_of(twin, {.most_searches = most, .threads = 3});
      EXPECT_EQ(start.node, again.node);
      EXPECT_EQ(start.gap, again.gap);
    }
  }
  EXPECT_GT(start_of(TwinSurface(test_meshes::geosphere(8)), {.most_searches = 3}).gap, 0.01);
}

// One edge, and nothing else to go by: all totals are known once the edge itself was searched from.
TEST(StartTriangle, OfABookTakesFewSearches) {
  constexpr std::uint32_t kPages = 200'000;
  test_meshes::Random random(1);
  DualGraph graph{.triangles = kPages, .first = {0}, .target = {}, .length = {}};
  std::vector<double> lengths;
  for (std::uint32_t page = 0; page < kPages; ++page) {
    lengths.push_back(random.between(1, 2));
    graph.target.push_back(kPages);
    graph.length.push_back(lengths.back());
    graph.first.push_back(page + 1);
  }
  graph.target.insert(graph.target.end(), graph.target.size(), 0);
  std::ranges::copy(numbers_up_to(kPages), graph.target.begin() + kPages);
  graph.length.insert(graph.length.end(), lengths.begin(), lengths.end());
  graph.first.push_back(2 * kPages);
  const StartTriangle start = find_start_triangle(graph, std::vector(kPages, 1.0), numbers_up_to(kPages));
  EXPECT_EQ(start.node, std::ranges::max_element(lengths) - lengths.begin());
  EXPECT_EQ(start.gap, 0);
  EXPECT_LE(start.searches, 20);
}

TEST(StartTriangle, CanBeCancelled) {
  const TwinSurface twin(test_meshes::torus(60, 40));
  std::stop_source stop;
  std::atomic<int> calls = 0;
  const StartSearchOptions options{.stop = stop.get_token(), .progress = [&](double fraction) {
                                     EXPECT_GE(fraction, 0);
                                     EXPECT_LE(fraction, 1);
                                     if (++calls == 2) stop.request_stop();
                                   }};
  EXPECT_THROW(start_of(twin, options), Cancelled);
}

}  // namespace
}  // namespace scene_analyzer::surface_distances
