#include "start_case.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "gpu/recorder.h"
#include "import/import.h"
#include "reference/surface_distances.h"
#include "stages.h"
#include "surface_distances/dual_graph.h"
#include "surface_distances/shortest_paths.h"
#include "surface_distances/side_by_side.h"
#include "surface_distances/start_triangle.h"

namespace scene_analyzer::bench {
namespace {

using surface_distances::Component;
using surface_distances::StartTriangle;
using test_meshes::TestMesh;

constexpr std::uint32_t kMostForAllPairs = 20000;
constexpr std::uint32_t kSampledSources = 64;

struct Surface {
  Component component;  // the largest
  std::vector<double> areas;
};

Surface surface_of(const pipeline::Measurer::Stages& stages, const TestMesh& mesh) {
  mesh::TriangleMesh source;
  source.positions = mesh.positions;
  source.indices = mesh.indices;
  gpu::Recorder recorder(stages.device);
  const auto geometry = stages.geometry.record(recorder, {.meshes = {{.mesh = &source}}}, 0);
  auto matching = stages.adjacency.record_matching(recorder, geometry);
  recorder.submit_and_wait();
  const auto adjacency = stages.adjacency.complete(stages.device, geometry, std::move(matching));
  const auto surfaces = stages.arcs.measure(stages.device, geometry, adjacency);
  const surface_distances::MeshSurface view = surfaces.surface(0, source);
  auto components = surface_distances::connected_components(view);
  if (components.empty()) throw std::runtime_error(mesh.name + ": no two triangles share an edge");
  Surface result{.component = std::move(*std::ranges::max_element(
                     components, {}, [](const Component& one) { return one.graph.triangles; })),
                 .areas = {}};
  for (const std::uint32_t triangle : result.component.triangles)
    result.areas.push_back(view.areas[triangle]);
  return result;
}

unsigned all_threads() {
  return std::max(1U, std::thread::hardware_concurrency());
}

// Totals of every `step`-th triangle, on all threads.
std::vector<double> totals_of_all(const surface_distances::DualGraph& graph, std::uint32_t count,
                                  std::uint32_t step) {
  const unsigned threads = all_threads();
  std::vector<surface_distances::ShortestPaths> paths(threads, surface_distances::ShortestPaths(graph));
  std::vector<std::vector<double>> distances(threads, std::vector<double>(graph.nodes()));
  std::vector<double> totals(count);
  surface_distances::run_side_by_side(count, threads, {}, [&](std::size_t i, std::size_t worker) {
    paths[worker].run(static_cast<std::uint32_t>(i) * step, distances[worker]);
    totals[i] = surface_distances::total_distance(graph, distances[worker]);
  });
  return totals;
}

// Node of the start triangle, with all totals known.
std::uint32_t winner_of(const std::vector<double>& totals, const Surface& surface) {
  const std::vector<std::uint32_t>& index = surface.component.triangles;
  std::vector<std::uint32_t> nodes(totals.size());
  std::iota(nodes.begin(), nodes.end(), 0U);
  std::ranges::sort(nodes, {}, [&](std::uint32_t node) { return index[node]; });
  std::vector<double> by_index;
  for (const std::uint32_t node : nodes) by_index.push_back(totals[node]);
  return reference::choose_start(nodes, by_index, surface.areas);
}

// Triangles into four, by the middles of their edges.
TestMesh subdivided(const TestMesh& mesh) {
  TestMesh result{.name = mesh.name, .positions = mesh.positions, .indices = {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, fresh] =
        known.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.positions.size() / 3));
    for (std::size_t axis = 0; fresh && axis < 3; ++axis)
      result.positions.push_back((mesh.positions[3 * a + axis] + mesh.positions[3 * b + axis]) / 2);
    return place->second;
  };
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const std::uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::uint32_t v : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) result.indices.push_back(v);
  }
  return result;
}

}  // namespace

StartRow StartBench::run(const TestMesh& mesh) {
  const Surface surface = surface_of(stages_, mesh);
  const surface_distances::DualGraph& graph = surface.component.graph;
  StartRow row{.name = mesh.name, .triangles = graph.triangles};
  StartTriangle start;
  row.seconds = elapsed_of([&] {
                  start = surface_distances::find_start_triangle(
                      graph, surface.areas, surface.component.triangles, {.threads = all_threads()});
                }).wall;
  row.searches = start.searches;
  row.gap = start.gap;
  row.extrapolated = graph.triangles > kMostForAllPairs;
  const std::uint32_t sources = row.extrapolated ? kSampledSources : graph.triangles;
  std::vector<double> totals;
  row.all_pairs_seconds =
      elapsed_of([&] { totals = totals_of_all(graph, sources, graph.triangles / sources); }).wall *
      graph.triangles / sources;
  if (!row.extrapolated && winner_of(totals, surface) != start.node)
    throw std::runtime_error(mesh.name + ": the start triangle is not that of all pairs");
  return row;
}

TestMesh load(const std::string& file) {
  const std::size_t at = file.rfind('@');
  const std::filesystem::path path = file.substr(0, at);
  const mesh::Scene scene = import::import_asset(path);
  if (scene.meshes.empty()) throw std::runtime_error(path.string() + ": no mesh");
  const mesh::TriangleMesh& largest =
      *std::ranges::max_element(scene.meshes, {}, [](const auto& mesh) { return mesh.indices.size(); });
  TestMesh mesh{.name = path.filename().string(),
                .positions = {largest.positions.begin(), largest.positions.end()},
                .indices = {largest.indices.begin(), largest.indices.end()}};
  const int times = at == std::string::npos ? 0 : std::stoi(file.substr(at + 1));
  for (int i = 0; i < times; ++i) mesh = subdivided(mesh);
  if (times > 0) mesh.name += " x" + std::to_string(1 << 2 * times);
  return mesh;
}

}  // namespace scene_analyzer::bench
