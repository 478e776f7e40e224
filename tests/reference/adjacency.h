// adjacency.h — Which triangles share an edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/geometry.h"

namespace scene_analyzer::reference {

// Half edge 3 * triangle + c runs from corner c to the next corner. Only kept triangles have any.
struct Adjacency {
  std::vector<std::uint64_t>
      first;  // per edge, and one past the end, into half_edges; edges by lower, then higher vertex
  std::vector<std::uint32_t> half_edges;  // ascending within an edge
  std::vector<std::uint32_t> neighbours;  // per triangle: |N_i|, a neighbour counts once per shared edge
  std::vector<std::uint32_t>
      component;  // per triangle: lowest triangle connected to it through edges; kNone when not kept
  std::uint64_t boundary_edges = 0;      // edges with one triangle
  std::uint64_t non_manifold_edges = 0;  // edges with more than two triangles
  std::uint64_t isolated_triangles = 0;  // kept triangles without a neighbour
  std::uint64_t components = 0;          // isolated triangles count

  std::size_t edge_count() const { return first.size() - 1; }
  std::span<const std::uint32_t> edge(std::size_t e) const {
    return std::span(half_edges).subspan(first[e], first[e + 1] - first[e]);
  }
};

// `kept`: per triangle, of measure_triangles(). Cost: linear but for sorting the half edges of each vertex.
Adjacency find_adjacency(const Geometry& geometry, std::span<const std::uint8_t> kept);

}  // namespace scene_analyzer::reference
