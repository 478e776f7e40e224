// lane_graph.h — Graphs for many searches at once: rows in the order in which searches reach them, about.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface_distances/distance_types.h"
#include "surface_distances/dual_graph.h"

namespace scene_analyzer::surface_distances {

// A directed graph whose rows are sorted, about, by distance from a place near all sources. A row stands for
// itself and for what was contracted into it (contraction.h).
template <typename Distance>
struct LaneGraph {
  std::vector<std::uint32_t> first;   // per row, and one past the end: arcs that leave it
  std::vector<std::uint32_t> target;  // per arc
  std::vector<Distance> length;       // per arc
  std::vector<std::uint32_t> mass;    // per row: triangles that it stands for
  SumOf<Distance> constant = 0;       // sum of the distances from rows to what they stand for
  // Rows at which bands of about the same width begin, multiples of 64, and the end, rounded up to one.
  std::vector<std::uint32_t> bands;

  std::uint32_t rows() const { return static_cast<std::uint32_t>(mass.size()); }
};

// Distances from a middle, in the graph's own measure, and how far the sources to come are from it.
struct RowOrder {
  std::span<const double> distances;
  double radius = 0;
};

// `graph` with rows in that order. Lengths are divided by `unit` and, for Units, rounded up. Cost: linear.
// Memory: 8 or 12 bytes per arc and 8 per row.
template <typename Distance>
LaneGraph<Distance> order_by_distance(const DualGraph& graph, const RowOrder& order, double unit,
                                      std::vector<std::uint32_t>& row_of_node);
LaneGraph<Units> order_by_distance(const LaneGraph<Units>& graph, const RowOrder& order,
                                   std::vector<std::uint32_t>& new_row);

extern template LaneGraph<double> order_by_distance(const DualGraph&, const RowOrder&, double,
                                                    std::vector<std::uint32_t>&);
extern template LaneGraph<Units> order_by_distance(const DualGraph&, const RowOrder&, double,
                                                   std::vector<std::uint32_t>&);

}  // namespace scene_analyzer::surface_distances
