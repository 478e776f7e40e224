// dual_graph.h — Triangles as nodes, shared edges as arcs: what distances along a surface are measured on.
//
// An arc between triangles i and j that share an edge with midpoint M has length |C_i - M| + |M - C_j|, C
// being centroids. An edge with k > 2 triangles becomes a node of its own with arcs of length |C - M| to all
// of them: the same distances with k arcs instead of k^2. Memory: 12 bytes per arc and 4 per node, about 40
// per triangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scene_analyzer::surface_distances {

// One connected component. Nodes [0, triangles) are triangles, ordered so that neighbours in space are near
// each other in memory; the rest are edges with more than two triangles.
struct DualGraph {
  std::uint32_t triangles = 0;
  std::vector<std::uint32_t> first;   // per node, and one past the end: its arcs
  std::vector<std::uint32_t> target;  // per arc
  std::vector<double> length;         // per arc, >= 0

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(first.size() - 1); }
};

// One mesh of a batch, read back from the device. Half-edges as in interface/adjacency.h.
struct MeshSurface {
  std::uint32_t first_triangle = 0;       // in the batch
  std::span<const double> areas;          // per triangle of the mesh; 0 for degenerate ones
  std::span<const std::uint32_t> twins;   // per half-edge of the mesh; they name half-edges of the batch
  std::span<const double> half_arcs;      // per half-edge of the mesh: |C - M|
  std::span<const std::uint32_t> shared;  // half-edges of the batch on edges with more than two triangles
  std::span<const std::uint32_t> shared_ends;  // per entry of `shared`: where its edge ends
  std::span<const float> positions;            // x, y, z per vertex of the mesh; only for the order of nodes
  std::span<const std::uint32_t> indices;      // three per triangle
};

struct Component {
  DualGraph graph;
  std::vector<std::uint32_t> triangles;  // per triangle node: index in the mesh
};

// The mesh's components; triangles without a neighbour are in none. Cost: n log n for the order.
std::vector<Component> connected_components(const MeshSurface& surface);

}  // namespace scene_analyzer::surface_distances
