// join_linked.comp — One thread per shared half-edge: unites list neighbours that some interval covers (see link_directions.comp).
//
// covered is the exclusive scan of the steps: its value at the next place counts the intervals that reach over this one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { JoinParams params; };
layout(binding = 0, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 1, scalar) readonly buffer Covered { uint covered[]; };
layout(binding = 2, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/union_find.glsl"

void main() {
  uint place = global_thread();
  if (place + 1 >= params.count) return;
  if (covered[place + 1] != 0) unite(half_edges[place] / 3, half_edges[place + 1] / 3);
}
