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

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  for (uint h = 3 * t; h < 3 * t + 3; ++h) {
    uint other = twin[h];
    bool among_many = is_shared(other);
    uint first = shared_half_edges[among_many ? other & ~kShared : 0];
    uint neighbour = among_many ? first / 3 : (other == kNone ? t : other / 3);
    // A pair on a manifold edge is seen from both sides: the higher triangle speaks for it.
    unite(t, min(t, neighbour));
  }
}
