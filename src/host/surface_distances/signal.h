// signal.h — A mesh as a one-dimensional signal: areas of triangles in the order of their distance from the
// start.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "surface_distances/dual_graph.h"

namespace scene_analyzer::surface_distances {

// Of triangles with neighbours; empty where there are none. Of several components the first is the largest.
struct Signal {
  std::vector<double> areas;
  std::uint32_t start_triangle = 0;  // of the first component: index in the mesh
  double mean_distance = 0;          // from there to the other triangles of that component
  double gap = 0;                    // largest of all components, see StartTriangle
  std::uint64_t searches = 0;        // most of all components
};

struct SignalOptions {
  std::uint64_t most_searches = 20000;  // per component
  unsigned threads = 1;
  std::stop_token stop = {};
  std::function<void(double fraction)> progress = {};  // from any thread, one call at a time
};

// One signal per surface, in order. Large components are searched one after another with all threads, small
// ones side by side; the result does not depend on their number. Throws Cancelled (start_triangle.h). Cost:
// see find_start_triangle(). Memory: about 80 bytes per triangle of all surfaces besides that search's.
std::vector<Signal> measure_signals(std::span<const MeshSurface> surfaces, const SignalOptions& options = {});

}  // namespace scene_analyzer::surface_distances
