// start_triangle.h — The triangle with the largest total distance to all others of its component, with proof.
//
// All pairs would take n searches. Instead every triangle has an upper bound U on its total F, and only
// triangles whose bound exceeds the best total found need a look:
//   1. |F(v) - F(u)| <= n d(u, v): a search from u bounds all others. Enough for scans, whose extremities
//   stand out.
//   2. On symmetric shapes all F are nearly equal. There a climb finds a good best first, searches far from
//   each other close what is clearly worse, and patches of triangles near each other are bounded on
//   contracted graphs (contraction.h), a few searches for hundreds of triangles.
//   3. What is left is searched for real.
// Totals are compared as doubles with the best one less 1e-9, within which totals count as equal: that covers
// their rounding (below 1e-12) and keeps all ties. Bounds of patches are counted in whole units, lengths
// rounded up: never too low, and some millionths too high, which costs a few more real searches. Of equal
// totals the smaller area wins (within 1e-9), then the lower index.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>

#include "surface_distances/dual_graph.h"
#include "surface_distances/side_by_side.h"

namespace scene_analyzer::surface_distances {

struct StartSearchOptions {
  // Work after which the search ends with what it has; a search from k sources on a graph contracted to m of
  // n rows counts k m / n. Counted, not timed, so that reruns agree.
  std::uint64_t most_searches = 20000;
  unsigned threads = 1;       // the result does not depend on it
  std::stop_token stop = {};  // throws Cancelled soon after it was asked for
  // About how much is done; called from the calling thread.
  std::function<void(double fraction)> progress = {};
};

struct StartTriangle {
  std::uint32_t node = 0;
  double total_distance = 0;  // to all triangles of the component
  // No triangle's total exceeds the largest found by more than this, relative; 0: proven to be as specified.
  double gap = 0;
  std::uint64_t searches = 0;  // see most_searches
};

// `areas` and `indices` per triangle node: what decides between equal totals. Cost: 20 to 200 searches on
// scans; on spheres and tori the work of n / 3 searches at n = 8000, of n / 100 at a million. Memory: about
// 130 bytes per triangle; on symmetric shapes 300 more per thread at work, and 200 where many totals tie.
StartTriangle find_start_triangle(const DualGraph& graph, std::span<const double> areas,
                                  std::span<const std::uint32_t> indices,
                                  const StartSearchOptions& options = {});

}  // namespace scene_analyzer::surface_distances
