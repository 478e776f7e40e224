// surface_distances.h — Distances along the surface, start triangle and signal: all pairs, as the definition
// says.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/adjacency.h"
#include "reference/geometry.h"
#include "reference/triangles.h"

namespace scene_analyzer::reference {

// Arcs between triangles, both ways; every pair of triangles on an edge has its own.
struct SurfaceArcs {
  struct Arc {
    std::uint32_t target;
    double length;  // |C_i - M| + |M - C_j|
  };
  std::vector<std::vector<Arc>> from;  // per triangle
};
SurfaceArcs surface_arcs(const Geometry& geometry, const TriangleMeasures& triangles,
                         const Adjacency& adjacency);

// The start triangle of a component: that of `members`, which come by index, with the highest total; of
// equal ones (within 1e-9) the smallest area, of equal ones again the first. `totals` per member, `areas` per
// triangle.
std::uint32_t choose_start(std::span<const std::uint32_t> members, std::span<const double> totals,
                           std::span<const double> areas);

// Infinity where there is no path. Dijkstra's algorithm with a binary heap.
std::vector<double> surface_distances(const SurfaceArcs& arcs, std::uint32_t source);

struct SurfaceComponent {
  std::uint32_t start = 0;     // triangle
  double total_distance = 0;   // from there
  std::vector<double> signal;  // areas
};

struct SurfaceSignal {
  std::vector<SurfaceComponent>
      components;  // in the specification's order; triangles without neighbour in none
  std::vector<double> values() const;
};

// Cost: n^2 log n in the triangles of each component.
SurfaceSignal surface_signal(const TriangleMeasures& triangles, const Adjacency& adjacency,
                             const SurfaceArcs& arcs);

// Total distance of one triangle to all others of its component.
double total_distance(const SurfaceArcs& arcs, std::uint32_t source);

// R_ft of a signal by direct summation; N^2.
double fourier_rating(std::span<const double> signal);

}  // namespace scene_analyzer::reference
