// patch_bounds.h — Upper bounds on the totals of triangles near each other, for far less than a search each.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface_distances/candidates.h"
#include "surface_distances/dual_graph.h"
#include "surface_distances/lane_search.h"
#include "surface_distances/shortest_paths.h"

namespace scene_analyzer::surface_distances {

// What a patch's bounding found, to be merged in the order of patches.
struct PatchResult {
  std::vector<std::pair<std::uint32_t, double>> totals;  // true ones
  std::vector<std::pair<std::uint32_t, double>> bounds;
  std::uint64_t work = 0;  // sources x rows
};

// Scratch of one thread. Patches up to kLanes triangles are searched for real; larger ones get true totals
// for 16 members and bounds for the rest. Memory: about 400 bytes per node.
class PatchBounder {
 public:
  explicit PatchBounder(const DualGraph& graph) : graph_(graph), paths_(graph), distances_(graph.nodes()) {}

  // `patch`: nodes near each other, the first about in the middle. Reads `candidates` only.
  PatchResult bound(const std::vector<std::uint32_t>& patch, const Candidates& candidates);

 private:
  struct Member {
    std::uint32_t row, node;
    double upper;
  };
  void refine_in_groups(const LaneGraph& rows, const std::vector<Member>& members, std::uint32_t near,
                        PatchResult& result);
  void refine(const LaneGraph& rows, std::vector<Member> members, std::uint32_t near, bool whole,
              PatchResult& result);
  std::vector<std::size_t> spread_sources(const std::vector<Member>& members) const;
  std::vector<Member> apply_totals(const LaneGraph& rows, std::vector<Member>& members,
                                   const std::vector<std::size_t>& sources, bool whole, PatchResult& result);
  void split(const LaneGraph& rows, const std::vector<Member>& open, std::size_t sources, double slack,
             PatchResult& result);

  const DualGraph& graph_;
  ShortestPaths paths_;
  std::vector<double> distances_;
  LaneSearch search_;
  const Candidates* candidates_ = nullptr;
  double best_ = 0;
  unsigned depth_ = 0;  // how often the graph at hand was contracted
};

}  // namespace scene_analyzer::surface_distances
