// patch_bounds.h — Upper bounds on the totals of triangles near each other, for far less than a search each.
#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>
#include <utility>
#include <vector>

#include "surface_distances/candidates.h"
#include "surface_distances/dual_graph.h"
#include "surface_distances/lane_search.h"
#include "surface_distances/patches.h"
#include "surface_distances/shortest_paths.h"

namespace scene_analyzer::surface_distances {

// What a patch's bounding found, to be merged in the order of patches.
struct PatchResult {
  std::vector<std::pair<std::uint32_t, double>> totals;  // true ones
  std::vector<std::pair<std::uint32_t, double>> bounds;
  std::uint64_t work = 0;  // sources x rows
  bool too_wide = false;   // nothing was found, for shortest paths have too little in common
};

// Scratch of one thread. Memory: about 300 bytes per node, 200 more once something was measured. Bounds are
// searched for in units of `unit`: four times the component's extent have to fit DistanceTraits<Units>.
class PatchBounder {
 public:
  PatchBounder(const DualGraph& graph, double unit)
      : graph_(graph), unit_(unit), paths_(graph), distances_(graph.nodes()) {}

  struct Rules {
    // Of the way from the patch's totals to the best, the part that making graphs smaller may use up.
    double slack_share = 0;
    std::uint64_t most_work = std::numeric_limits<std::uint64_t>::max();  // sources x rows, about
    std::stop_token stop = {};
  };
  // Bounds all of `patch` on smaller and smaller graphs, unless it is too wide; what is left when the work is
  // done or a stop is asked for gets no new bound. Reads `candidates` only, as do all of these.
  PatchResult bound(const Patch& patch, const Candidates& candidates, const Rules& rules);
  // Looks at 16 spread members: true total of the most promising one, bounds for all.
  PatchResult sample(const Patch& patch, const Candidates& candidates);
  // True totals; at most kLanes nodes.
  PatchResult measure(const Patch& patch);

 private:
  struct Member {
    std::uint32_t row, node;
    double upper;
  };
  // The graph's nodes as rows, by their distance from a patch's middle.
  template <typename Distance>
  struct Rows {
    LaneGraph<Distance> graph;
    std::vector<std::uint32_t> of_node;
    std::uint32_t near = 0;  // rows that the patch reaches, about
  };
  template <typename Distance>
  Rows<Distance> order_around(const Patch& patch, double unit);
  Rows<Units> begin(const Patch& patch, const Candidates& candidates, std::vector<Member>& members);
  PatchResult measure_apart(const Patch& patch);
  PatchResult measure_together(const Patch& patch);
  void refine(const LaneGraph<Units>& rows, std::vector<Member> members, std::uint32_t near);
  void refine_in_groups(const LaneGraph<Units>& rows, const std::vector<Member>& members, std::uint32_t near);
  std::vector<Member> search(const LaneGraph<Units>& rows, std::vector<Member>& members, std::uint32_t near,
                             const std::vector<std::size_t>& sources);
  void raise_best(Member& member);
  std::vector<std::size_t> spread_sources(const std::vector<Member>& members) const;
  void split(const LaneGraph<Units>& rows, const std::vector<Member>& open, double slack);

  const DualGraph& graph_;
  double unit_;
  ShortestPaths paths_;
  std::vector<double> distances_;
  LaneSearch<Units> search_;
  LaneSearch<double> exact_search_;
  // Of the patch at hand:
  const Candidates* candidates_ = nullptr;
  PatchResult result_;
  double best_ = 0;
  Rules rules_;
  unsigned depth_ = 0;  // how often the graph at hand was contracted
};

}  // namespace scene_analyzer::surface_distances
