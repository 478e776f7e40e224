// join_components.comp — One thread per triangle: unites it with its neighbours. On a shared edge everybody joins the first of the
// edge's list, so such an edge costs k, not k^2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) readonly buffer Shared { uint shared_half_edges[]; };
layout(binding = 2, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/half_edges.glsl"
#include "compute/lib/union_find.glsl"

uint neighbour_across(uint other, uint t) {
  bool among_many = is_shared(other);
  uint first = shared_half_edges[among_many ? other & ~kShared : 0];
  return among_many ? first / 3 : (other == kNone ? t : other / 3);
}

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  // A pair on a manifold edge is seen from both sides: the higher triangle speaks for it. The lowest neighbour is united last, so that what is
  // found on the way stays short.
  uint lowest = t;
  for (uint h = 3 * t; h < 3 * t + 3; ++h) {
    uint neighbour = neighbour_across(twin[h], t);
    uint later = min(lowest, neighbour);
    uint now = max(lowest, neighbour);
    // A loop instead of a branch: see sum_contrast.comp.
    for (bool joins = now < t; joins; joins = false) unite(t, now);
    lowest = later;
  }
  for (bool joins = lowest < t; joins; joins = false) unite(t, lowest);
}
