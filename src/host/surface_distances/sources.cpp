#include "surface_distances/sources.h"

#include <algorithm>
#include <utility>

namespace scene_analyzer::surface_distances {
namespace {

constexpr std::uint32_t kLeastOnHub = 16;  // triangles
constexpr std::size_t kMostHubs = 8;

}  // namespace

std::vector<std::uint32_t> hubs(const DualGraph& graph) {
  const auto triangles_on = [&](std::uint32_t node) { return graph.first[node + 1] - graph.first[node]; };
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t node = graph.triangles; node < graph.nodes(); ++node)
    if (triangles_on(node) >= kLeastOnHub) nodes.push_back(node);
  const std::size_t taken = std::min(nodes.size(), kMostHubs);
  std::ranges::partial_sort(
      nodes, nodes.begin() + static_cast<std::ptrdiff_t>(taken), {},
      [&](std::uint32_t node) { return std::pair(-std::int64_t{triangles_on(node)}, node); });
  nodes.resize(taken);
  return nodes;
}

std::vector<std::uint32_t> highest_bounds(const std::vector<std::uint32_t>& open,
                                          const Candidates& candidates, std::size_t count) {
  const auto n = static_cast<double>(candidates.count());
  std::vector<double> expected;
  expected.reserve(open.size());
  for (const std::uint32_t v : open) expected.push_back(candidates.upper(v));
  std::vector<std::uint32_t> sources;
  while (sources.size() < std::min(count, open.size())) {
    const auto highest = static_cast<std::size_t>(std::ranges::max_element(expected) - expected.begin());
    if (expected[highest] < candidates.threshold()) break;
    const std::uint32_t source = open[highest];
    sources.push_back(source);
    for (std::size_t i = 0; i < open.size(); ++i)
      expected[i] = std::min(expected[i], candidates.best() + n * candidates.about_distance(open[i], source));
    expected[highest] = -1;
  }
  return sources;
}

std::vector<std::size_t> farthest_apart(const std::vector<std::uint32_t>& nodes, std::vector<float> nearest,
                                        const Candidates& candidates, std::size_t count) {
  std::vector<std::size_t> taken;
  while (taken.size() < std::min(count, nodes.size())) {
    const auto farthest = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
    taken.push_back(farthest);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nearest[i] = std::min(nearest[i], candidates.about_distance(nodes[i], nodes[farthest]));
    nearest[farthest] = -1;
  }
  return taken;
}

std::vector<std::uint32_t> far_from_all(const std::vector<std::uint32_t>& open, const Candidates& candidates,
                                        std::size_t count) {
  std::vector<float> nearest;
  nearest.reserve(open.size());
  for (const std::uint32_t v : open) nearest.push_back(candidates.nearest(v));
  std::vector<std::uint32_t> sources;
  for (const std::size_t i : farthest_apart(open, std::move(nearest), candidates, count))
    sources.push_back(open[i]);
  return sources;
}

}  // namespace scene_analyzer::surface_distances
