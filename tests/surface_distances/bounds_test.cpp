// Upper bounds are what the proof rests on: none may ever be below the true total.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <string>

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

// By brute force, once per mesh.
const std::vector<double>& all_totals(const TwinSurface& twin, const std::string& name) {
  static auto& known = *new std::map<std::string, std::vector<double>>;
  std::vector<double>& totals = known[name];
  for (auto t = static_cast<std::uint32_t>(totals.size()); t < twin.arcs.from.size(); ++t)
    totals.push_back(reference::total_distance(twin.arcs, t));
  return totals;
}

TEST(Contraction, NeverShortensAndKeepsTheMass) {
  for (const auto& mesh : meshes()) {
    const TwinSurface twin(mesh);
    const DualGraph graph = graph_of(twin);
    std::vector<double> distances(graph.nodes());
    ShortestPaths(graph).run(0, distances);
    std::vector<std::uint32_t> near = numbers_up_to(graph.nodes());
    std::ranges::sort(near, {}, [&](std::uint32_t v) { return distances[v]; });
    const double extent = distances[near.back()], unit = 4 * extent / kUnreached<Units>;
    std::vector<std::uint32_t> row, sources;
    const auto rows = order_by_distance<Units>(graph, {distances, distances[near[60]]}, unit, row);
    for (std::size_t i = 0; i < kLanes; ++i) sources.push_back(row[near[3 * i]]);
    LaneSearch<Units> search;
    search.run(rows, sources, 0);
    const auto totals = search.totals(rows);
    for (const double share : {0.0, 0.002, 0.05}) {
      const auto tolerance = static_cast<Units>(share * extent / unit);
      const Contraction smaller = contract(rows, search.distances(), sources, tolerance);
      std::uint64_t mass = 0;
      for (const std::uint32_t m : smaller.graph.mass) mass += m;
      EXPECT_EQ(mass, graph.triangles) << mesh.name;
      EXPECT_LE(smaller.graph.rows(), rows.rows()) << mesh.name;
      std::vector<std::uint32_t> again;
      for (const std::uint32_t source : sources) {
        EXPECT_EQ(smaller.roots[smaller.row[source]], source) << "kept";
        again.push_back(smaller.row[source]);
      }
      LaneSearch<Units> bounded;
      bounded.run(smaller.graph, again, smaller.graph.rows());
      const auto bounds = bounded.totals(smaller.graph);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        EXPECT_GE(bounds[lane], totals[lane]) << mesh.name;
        EXPECT_LE(bounds[lane], totals[lane] * (1 + 20 * share)) << mesh.name << ", share " << share;
      }
    }
  }
}

TEST(Patches, TakeEveryOpenTriangleOnceAndStayWithinReach) {
  Candidates candidates(500);
  test_meshes::Random random(4);
  std::vector<double> distances(500);
  for (std::size_t source = 0; source < kLandmarks; ++source) {
    for (double& distance : distances) distance = random.unit();
    candidates.bound_all(500, distances);
  }
  std::vector<std::uint32_t> open = candidates.open(), seen;
  ASSERT_EQ(open.size(), 500U);
  while (!open.empty()) {
    const std::size_t before = open.size();
    const auto patches = take_patches(open, candidates, {.least = 3, .most = 40, .reach = 0.6}, 4);
    EXPECT_FALSE(patches.empty());
    EXPECT_LE(patches.size(), 4U);
    std::size_t taken = 0;
    for (const Patch& patch : patches) {
      taken += patch.size();
      EXPECT_LE(patch.size(), 40U);
      for (std::size_t i = 3; i < patch.size(); ++i)
        EXPECT_LE(candidates.about_distance(patch[0], patch[i]), 0.6F);
      seen.insert(seen.end(), patch.begin(), patch.end());
    }
    EXPECT_EQ(open.size() + taken, before);
  }
  std::ranges::sort(seen);
  EXPECT_EQ(seen, numbers_up_to(500));
}

// The same distances with a node in the middle of every third arc, as on edges with more than two triangles.
DualGraph with_edge_nodes(const DualGraph& graph) {
  reference::SurfaceArcs arcs;
  arcs.from.resize(graph.triangles);
  for (std::uint32_t v = 0; v < graph.triangles; ++v)
    for (std::uint32_t arc = graph.first[v]; arc < graph.first[v + 1]; ++arc) {
      const std::uint32_t target = graph.target[arc];
      const double length = graph.length[arc];
      if ((v + target) % 3 != 0) {
        arcs.from[v].push_back({target, length});
      } else if (v < target) {
        const auto middle = static_cast<std::uint32_t>(arcs.from.size());
        arcs.from.emplace_back();
        connect(arcs, v, middle, length / 2);
        connect(arcs, middle, target, length / 2);
      }
    }
  DualGraph result = graph_of(arcs);
  result.triangles = graph.triangles;
  return result;
}

class PatchBounds : public testing::Test {
 protected:
  // Every mesh with its true totals and what 16 searches prove.
  template <typename Visit>
  static void for_each_case(Visit visit) {
    for (const auto& mesh : meshes()) {
      SCOPED_TRACE(mesh.name);
      const TwinSurface twin(mesh);
      const std::vector<double>& truth = all_totals(twin, mesh.name);
      const DualGraph graph = graph_of(twin);
      visit_patches(graph, truth, visit);
      visit_patches(with_edge_nodes(graph), truth, visit);
    }
  }

  template <typename Visit>
  static void visit_patches(const DualGraph& graph, const std::vector<double>& truth, Visit visit) {
    Candidates candidates(graph.triangles);
    std::vector<double> distances(graph.nodes());
    ShortestPaths paths(graph);
    for (std::uint32_t i = 0; i < kLandmarks; ++i) {
      const std::uint32_t source = i * (graph.triangles / kLandmarks);
      paths.run(source, distances);
      candidates.set_total(source, total_distance(graph, distances));
      candidates.bound_all(total_distance(graph, distances), distances);
    }
    PatchBounder bounder(graph, 4 * *std::ranges::max_element(distances) / kUnreached<Units>);
    Patch near = candidates.open();
    if (near.empty()) return;
    const std::uint32_t middle = near[near.size() / 2];
    std::ranges::stable_sort(
        near, {}, [&](std::uint32_t v) { return v == middle ? -1 : candidates.about_distance(v, middle); });
    for (const std::size_t size : {5U, 16U, 40U, 120U, 255U, 300U, 1U << 20}) {
      Patch patch = near;
      patch.resize(std::min(size, patch.size()));
      visit(bounder, patch, candidates, truth);
    }
  }

  static void expect_true(const PatchResult& result, const Patch& patch, const std::vector<double>& truth) {
    for (const auto& [v, total] : result.totals) EXPECT_NEAR(total, truth[v], 1e-12 * truth[v]);
    for (const auto& [v, bound] : result.bounds) EXPECT_GE(bound, truth[v] * (1 - 1e-12));
    std::vector<std::uint32_t> bounded;
    for (const auto& [v, bound] : result.bounds) bounded.push_back(v);
    std::ranges::sort(bounded);
    std::vector<std::uint32_t> expected = patch;
    std::ranges::sort(expected);
    EXPECT_EQ(bounded, expected) << "each once";
  }
};

TEST_F(PatchBounds, AreNeverBelowTheTruth) {
  std::size_t bounded = 0, split = 0;
  for_each_case([&](PatchBounder& bounder, const Patch& patch, const Candidates& candidates,
                    const std::vector<double>& truth) {
    for (const double share : {0.0, 0.2, 1.0}) {
      const PatchResult result = bounder.bound(patch, candidates, {.slack_share = share});
      if (result.too_wide) {
        EXPECT_TRUE(result.totals.empty() && result.bounds.empty());
        continue;
      }
      expect_true(result, patch, truth);
      ++bounded;
      if (result.work > 30 * truth.size()) ++split;  // more than the first level can have taken
    }
  });
  EXPECT_GT(bounded, 100U);
  EXPECT_GT(split, 30U);
}

TEST_F(PatchBounds, EndWithTheWorkAllowedOrWhenStopped) {
  std::stop_source stopped;
  stopped.request_stop();
  for_each_case([&](PatchBounder& bounder, const Patch& patch, const Candidates& candidates,
                    const std::vector<double>& truth) {
    const std::uint64_t all = bounder.bound(patch, candidates, {}).work;
    const PatchResult some = bounder.bound(patch, candidates, {.slack_share = 0.1, .most_work = all / 2});
    for (const auto& [v, bound] : some.bounds) EXPECT_GE(bound, truth[v] * (1 - 1e-12));
    EXPECT_TRUE(bounder.bound(patch, candidates, {.stop = stopped.get_token()}).bounds.empty());
  });
}

TEST_F(PatchBounds, OfASampleAreNeverBelowTheTruthEither) {
  for_each_case([](PatchBounder& bounder, const Patch& patch, const Candidates& candidates,
                   const std::vector<double>& truth) {
    const PatchResult result = bounder.sample(patch, candidates);
    if (!result.too_wide) expect_true(result, patch, truth);
  });
}

TEST_F(PatchBounds, MeasuredTotalsAreTrue) {
  for_each_case([](PatchBounder& bounder, Patch patch, const Candidates&, const std::vector<double>& truth) {
    patch.resize(std::min(patch.size(), kLanes));
    const PatchResult result = bounder.measure(patch);
    ASSERT_EQ(result.totals.size(), patch.size());
    for (const auto& [v, total] : result.totals) EXPECT_NEAR(total, truth[v], 1e-12 * truth[v]);
  });
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
    const std::vector<double>& truth = all_totals(twin, mesh.name);
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

// As long as lengths are >= 0, whatever they are.
TEST(StartTriangle, OfTrianglesAllInOnePlaceIsTheSmallest) {
  for (const std::uint32_t count : {2U, 3U, 500U}) {
    reference::SurfaceArcs arcs;
    arcs.from.resize(count);
    for (std::uint32_t v = 1; v < count; ++v) connect(arcs, v - 1, v, 0);
    std::vector<double> areas(count, 2);
    areas[1] = 1;
    const StartTriangle start = find_start_triangle(graph_of(arcs), areas, numbers_up_to(count));
    EXPECT_EQ(start.node, 1U);
    EXPECT_EQ(start.total_distance, 0);
    EXPECT_EQ(start.gap, 0);
  }
}

// Copies in one place cannot be told apart by their distances to anything.
TEST(StartTriangle, OfManyCopiesInOnePlaceIsFound) {
  constexpr std::uint32_t kCopies = 600;
  test_meshes::Random random(3);
  reference::SurfaceArcs arcs;
  arcs.from.resize(kCopies + 40);
  for (std::uint32_t v = 1; v < 40; ++v) connect(arcs, v - 1, v, 1 + random.unit());
  for (std::uint32_t v = 40; v < 40 + kCopies; ++v) connect(arcs, 0, v, 1);
  std::vector<double> totals;
  for (std::uint32_t v = 0; v < arcs.from.size(); ++v) totals.push_back(reference::total_distance(arcs, v));
  const StartTriangle start =
      find_start_triangle(graph_of(arcs), std::vector(arcs.from.size(), 1.0), numbers_up_to(kCopies + 40));
  EXPECT_EQ(start.node, std::ranges::max_element(totals) - totals.begin());
  EXPECT_EQ(start.gap, 0);
}

TEST(StartTriangle, CanBeCancelled) {
  const TwinSurface twin(test_meshes::torus(60, 40));
  std::stop_source stop;
  std::atomic<int> calls = 0;
  double last = 0;
  const StartSearchOptions options{.stop = stop.get_token(), .progress = [&](double fraction) {
                                     EXPECT_GE(fraction, 0);
                                     EXPECT_LE(fraction, 1);
                                     EXPECT_GE(fraction, last) << "never back";
                                     last = fraction;
                                     if (++calls == 2) stop.request_stop();
                                   }};
  EXPECT_THROW(start_of(twin, options), Cancelled);
}

}  // namespace
}  // namespace scene_analyzer::surface_distances
