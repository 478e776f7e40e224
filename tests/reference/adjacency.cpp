#include "reference/adjacency.h"

#include <algorithm>
#include <tuple>

#include "reference/disjoint_sets.h"

namespace scene_analyzer::reference {
namespace {

struct Spoke {
  std::uint32_t higher;  // the other vertex of the edge
  std::uint32_t half_edge;
};

std::uint32_t lower_vertex(const Geometry& geometry, std::uint32_t half_edge) {
  return std::min(geometry.half_edge_from(half_edge), geometry.half_edge_to(half_edge));
}
std::uint32_t higher_vertex(const Geometry& geometry, std::uint32_t half_edge) {
  return std::max(geometry.half_edge_from(half_edge), geometry.half_edge_to(half_edge));
}

// Half edges bucketed by lower vertex (a counting sort), each bucket sorted by higher vertex. `bucket` gets
// one offset per vertex.
std::vector<Spoke> sorted_spokes(const Geometry& geometry, std::span<const std::uint8_t> kept,
                                 std::vector<std::uint64_t>& bucket) {
  const std::size_t vertices = geometry.representative.size();
  const auto half_edges = static_cast<std::uint32_t>(3 * kept.size());
  bucket.assign(vertices + 2, 0);
  for (std::uint32_t h = 0; h < half_edges; ++h)
    if (kept[h / 3]) ++bucket[lower_vertex(geometry, h) + 2];
  for (std::size_t v = 2; v < bucket.size(); ++v) bucket[v] += bucket[v - 1];
  std::vector<Spoke> spokes(bucket.back());
  // bucket[v + 1] is the next free place of v while scattering, and so the start of v + 1 afterwards.
  for (std::uint32_t h = 0; h < half_edges; ++h)
    if (kept[h / 3]) spokes[bucket[lower_vertex(geometry, h) + 1]++] = {higher_vertex(geometry, h), h};
  for (std::size_t v = 0; v < vertices; ++v)
    std::sort(spokes.begin() + static_cast<std::ptrdiff_t>(bucket[v]),
              spokes.begin() + static_cast<std::ptrdiff_t>(bucket[v + 1]),
              [](const Spoke& a, const Spoke& b) {
                return std::tie(a.higher, a.half_edge) < std::tie(b.higher, b.half_edge);
              });
  return spokes;
}

void group_edges(const Geometry& geometry, std::span<const std::uint8_t> kept, Adjacency& result) {
  std::vector<std::uint64_t> bucket;
  const std::vector<Spoke> spokes = sorted_spokes(geometry, kept, bucket);
  result.half_edges.reserve(spokes.size());
  for (std::size_t v = 0; v + 2 < bucket.size(); ++v)
    for (std::uint64_t s = bucket[v]; s < bucket[v + 1]; ++s) {
      if (s == bucket[v] || spokes[s].higher != spokes[s - 1].higher) result.first.push_back(s);
      result.half_edges.push_back(spokes[s].half_edge);
    }
  result.first.push_back(spokes.size());
}

void count_edges(std::span<const std::uint8_t> kept, Adjacency& result) {
  DisjointSets sets(kept.size());
  for (std::size_t e = 0; e < result.edge_count(); ++e) {
    const std::span<const std::uint32_t> edge = result.edge(e);
    if (edge.size() == 1) ++result.boundary_edges;
    if (edge.size() > 2) ++result.non_manifold_edges;
    for (const std::uint32_t half_edge : edge) {
      result.neighbours[half_edge / 3] += static_cast<std::uint32_t>(edge.size() - 1);
      sets.unite(edge.front() / 3, half_edge / 3);
    }
  }
  for (std::uint32_t triangle = 0; triangle < kept.size(); ++triangle) {
    if (!kept[triangle]) continue;
    result.component[triangle] = sets.find(triangle);
    if (result.component[triangle] == triangle) ++result.components;
    if (result.neighbours[triangle] == 0) ++result.isolated_triangles;
  }
}

}  // namespace

Adjacency find_adjacency(const Geometry& geometry, std::span<const std::uint8_t> kept) {
  Adjacency result;
  result.neighbours.resize(kept.size());
  result.component.assign(kept.size(), kNone);
  group_edges(geometry, kept, result);
  count_edges(kept, result);
  return result;
}

}  // namespace scene_analyzer::reference
