// lane_search.h — Distances from up to 16 sources near each other, at once: one read of the graph serves all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface_distances/lane_graph.h"
#include "surface_distances/shortest_paths.h"

namespace scene_analyzer::surface_distances {

inline constexpr std::size_t kLanes = 16;

template <typename Distance>
struct alignas(kLanes * sizeof(Distance)) Lanes {
  std::array<Distance, kLanes> of;
};

template <typename Distance>
class LaneSearch {
 public:
  // Afterwards distances()[row].of[i] is that from sources[i]. At most kLanes sources, at least one; lanes
  // without a source repeat the first. Exact like ShortestPaths. Cost: where rows are well ordered that of
  // two searches on the same graph, for sources far apart that of five. Memory: 64 (Units) or 128 (double)
  // bytes per row, kept for the next run.
  //
  // Among the sources the order of rows serves no lane: the first `near` rows are searched lane by lane
  // before all others are done together. A little more than the sources' distance from the middle is a good
  // reach for them.
  void run(const LaneGraph<Distance>& graph, std::span<const std::uint32_t> sources, std::uint32_t near);
  // False, with nothing found, where the order of rows serves the lanes so badly that searches one by one,
  // which run() changes to, would be cheaper.
  bool try_together(const LaneGraph<Distance>& graph, std::span<const std::uint32_t> sources,
                    std::uint32_t near);
  std::span<const Lanes<Distance>> distances() const { return distances_; }

  // Per lane: graph.constant + sum over rows of mass x distance, in units of length 1; infinity where a
  // distance is too long for Units.
  std::array<double, kLanes> totals(const LaneGraph<Distance>& graph) const;

 private:
  void search_apart(const LaneGraph<Distance>& graph, std::span<const std::uint32_t> sources,
                    std::uint32_t rows);

  std::vector<Lanes<Distance>> distances_;
  BasicShortestPaths<Distance> paths_;
  std::vector<Distance> row_distances_;      // of one lane
  std::vector<std::uint64_t> waiting_;       // a bit per row that has to be looked at
  std::vector<std::uint32_t> band_of_word_;  // per 64 rows
};

extern template class LaneSearch<double>;
extern template class LaneSearch<Units>;

}  // namespace scene_analyzer::surface_distances
