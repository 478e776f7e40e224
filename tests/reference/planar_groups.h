// planar_groups.h — Connected components of neighbours in one plane.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/adjacency.h"
#include "reference/geometry.h"
#include "reference/triangles.h"

namespace scene_analyzer::reference {

struct PlanarGroups {
  std::vector<std::uint32_t> group;  // per triangle: lowest triangle of its group; kNone when not kept
  std::vector<std::uint32_t>
      size;                   // per triangle that is the lowest of a group: triangles in it; otherwise 0
  std::uint64_t count = 0;    // |PG|
  std::uint64_t largest = 0;  // triangles of the largest group
  std::uint64_t squared_sizes = 0;  // sum over groups with more than one triangle of size^2
};

// Neighbours belong together when the angle between their normals is <= alpha + tol; see docs/metrics.md for
// tol and for the flip of inconsistently wound neighbours. `alpha_degrees` in [0, 180]. Cost: k log k per
// edge of k triangles.
PlanarGroups planar_groups(const Geometry& geometry, const TriangleMeasures& triangles,
                           const Adjacency& adjacency, double alpha_degrees);

// The same by looking at every pair of every edge: k^2, the twin's own oracle.
PlanarGroups planar_groups_all_pairs(const Geometry& geometry, const TriangleMeasures& triangles,
                                     const Adjacency& adjacency, double alpha_degrees);

}  // namespace scene_analyzer::reference
