// count_run_bins.comp — One thread per run of the window: the pairs of its bin with each bin of its edge, at most kBins of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { RunBinParams params; };
layout(binding = 0, scalar) readonly buffer Low { uint low[]; };
layout(binding = 1, scalar) readonly buffer High { uint high[]; };
layout(binding = 2, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 3, scalar) readonly buffer Firsts { uint firsts[]; };
layout(binding = 4, scalar) readonly buffer Ends { uint ends[]; };
layout(binding = 5, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 6, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 7, scalar) buffer Counters { uint counters[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/label_runs.glsl"
#include "compute/lib/wide_counters.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.count) return;
  uint own = params.first + index;
  Edge edge = edge_of_run(own);
  uint row = (mesh_of[half_edges[edge.begin] / 3] - params.first_mesh) * kBins + label_of_run(own);
  for (uint other = edge.first_run; other < edge.end_run; ++other) add_wide(row * kBins + label_of_run(other), pairs_of_runs(own, other));
}
