// lane_search.h — Distances from up to 16 sources near each other, at once: one read of the graph serves all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface_distances/dual_graph.h"
#include "surface_distances/shortest_paths.h"

namespace scene_analyzer::surface_distances {

inline constexpr std::size_t kLanes = 16;

// A directed graph whose rows are sorted, about, by distance from a place near all sources. A row stands for
// itself and for what was contracted into it (contraction.h).
struct LaneGraph {
  std::vector<std::uint32_t> first;   // per row, and one past the end: arcs that leave it
  std::vector<std::uint32_t> target;  // per arc
  std::vector<double> length;         // per arc
  std::vector<double> mass;           // per row: triangles that it stands for
  double constant = 0;                // sum of the distances from rows to what they stand for

  std::uint32_t rows() const { return static_cast<std::uint32_t>(mass.size()); }
};

// `graph` with rows in the order of `distances`. Cost: linear.
LaneGraph order_by_distance(const DualGraph& graph, std::span<const double> distances,
                            std::vector<std::uint32_t>& row_of_node);
LaneGraph order_by_distance(const LaneGraph& graph, std::span<const double> distances,
                            std::vector<std::uint32_t>& new_row);

struct alignas(64) Lanes {
  std::array<double, kLanes> of;
};

class LaneSearch {
 public:
  // Afterwards distances()[row].of[i] is that from sources[i]. At most kLanes sources, at least one; lanes
  // without a source repeat the first. Exact like ShortestPaths. Cost: about twice that of one search on the
  // same graph when rows are well ordered. Memory: 128 bytes per row, kept for the next run.
  //
  // Among the sources the order of rows serves no lane: the first `near` rows are searched lane by lane
  // before all others are done together. Twice or thrice the sources' distance from the middle is a good
  // reach for them.
  void run(const LaneGraph& graph, std::span<const std::uint32_t> sources, std::uint32_t near);
  std::span<const Lanes> distances() const { return distances_; }

  // Per lane: graph.constant + sum over rows of mass x distance.
  std::array<double, kLanes> totals(const LaneGraph& graph) const;

 private:
  bool search_together(const LaneGraph& graph, std::span<const std::uint32_t> sources, std::uint32_t near);
  void search_apart(const LaneGraph& graph, std::span<const std::uint32_t> sources, std::uint32_t rows);

  std::vector<Lanes> distances_;
  ShortestPaths paths_;
  std::vector<double> row_distances_;   // of one lane
  std::vector<std::uint64_t> waiting_;  // a bit per row that has to be looked at
};

}  // namespace scene_analyzer::surface_distances
