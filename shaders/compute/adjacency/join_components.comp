// join_components.comp — One thread per triangle: unites it with those lower neighbours that start_components.comp left.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) readonly buffer Shared { uint shared_half_edges[]; };
layout(binding = 2, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/adjacency/neighbours.glsl"
#include "compute/lib/union_find.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  for (uint h = 3 * t; h < 3 * t + 3; ++h) {
    uint neighbour = neighbour_across(h, t);
    // A pair is seen from both sides: the higher triangle speaks for it. A loop instead of a branch: see sum_contrast.comp.
    for (bool joins = neighbour < t && parent[neighbour] != parent[t]; joins; joins = false) unite(t, neighbour);
  }
}
