// sum_run_pairs.comp — One thread per run: how many pairs with runs of its edge there are, itself included, added up per mesh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { RunPairParams params; };
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
  uint run = global_thread();
  if (run >= params.runs) return;
  Edge edge = edge_of_run(run);
  add_wide(mesh_of[half_edges[edge.begin] / 3], uint64_t(edge.end_run - edge.first_run));
}
