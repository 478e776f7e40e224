// contraction.h — A smaller graph on which distances from a patch of rows are never too short, and rarely too
// long.
//
// An arc x -> y that lies on shortest paths from all 16 sources of a search lies, most likely, also on the
// shortest paths from whatever is between them. So y is made a child of x: the root of such a tree stands for
// all of it. A path that is forced through the root can only be too long, which makes sums over the smaller
// graph upper bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface_distances/lane_search.h"

namespace scene_analyzer::surface_distances {

struct Contraction {
  LaneGraph<Units> graph;            // its rows in the order of the old ones; without bands
  std::vector<std::uint32_t> row;    // per old row: its row in `graph`, or that of its root
  std::vector<std::uint32_t> roots;  // per new row: the old one
};

// `distances`: of a search on `graph`. `kept`: rows that stay roots. `tolerance`: how much longer than
// shortest the way from a root to what it stands for may be, for any source; along a path that adds up. All
// roots stay within reach of all sources. Cost and scratch memory: linear.
Contraction contract(const LaneGraph<Units>& graph, std::span<const Lanes<Units>> distances,
                     std::span<const std::uint32_t> kept, Units tolerance);

}  // namespace scene_analyzer::surface_distances
