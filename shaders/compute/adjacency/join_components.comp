// join_components.comp — One thread per triangle: unites it with its neighbours. On a shared edge everybody joins the lowest half-edge's
// triangle, so such an edge costs k, not k^2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/union_find.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  for (uint h = 3 * t; h < 3 * t + 3; ++h) {
    uint other = twin[h];
    uint neighbour = other == kNone ? t : (other & ~kShared) / 3;
    // A pair on a manifold edge is seen from both sides: the higher triangle speaks for it.
    unite(t, min(t, neighbour));
  }
}
