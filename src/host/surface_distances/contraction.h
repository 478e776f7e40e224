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

struct ContractionRules {
  std::span<const std::uint32_t> kept_rows;  // rows that stay roots
  std::size_t centre_lane = 0;
  double kept_radius = 0;  // rows up to this distance from the source of `centre_lane` stay roots, too
  double tolerance = 0;    // how much longer than shortest the way through a parent may be, per source
};

struct Contraction {
  LaneGraph graph;                   // its rows in the order of the old ones
  std::vector<std::uint32_t> row;    // per old row: its row in `graph`, or that of its root
  std::vector<std::uint32_t> roots;  // per new row: the old one
};

// `distances`: of a search on `graph`. Cost and scratch memory: linear.
Contraction contract(const LaneGraph& graph, std::span<const Lanes> distances, const ContractionRules& rules);

}  // namespace scene_analyzer::surface_distances
