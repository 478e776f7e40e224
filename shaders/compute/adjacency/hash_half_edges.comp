// hash_half_edges.comp — One thread per half-edge: threads the half-edges of each edge onto a list, table[slot] -> next -> next.
//
// Half-edges of one edge find each other through an open-addressed table of half-edge indices that compares the two vertices.
// The first slots tried lie at a place proportional to the lower vertex: files list neighbours near each other, so these probes hit the cache. A
// vertex with very many edges would fill its surroundings; after kLocalProbes the search goes on at a random place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
#include "compute/lib/hashing.glsl"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { HashParams params; };
layout(binding = 0, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 1, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 2, scalar) coherent buffer Table { uint table[]; };
layout(binding = 3, scalar) writeonly buffer Next { uint next[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/half_edges.glsl"

void main() {
  uint h = global_thread();
  if (h >= params.half_edges) return;
  uvec2 edge = edge_of(h);
  uint slot = min(uint(double(edge.x) * params.slots_per_vertex), params.slots - 1);
  uint probes = 0;
  uint before = kNone;
  bool searching = areas[h / 3] > 0.0LF;
  while (searching) {
    uint other = table[slot];
    if (other == kNone) other = atomicCompSwap(table[slot], kNone, h);
    bool claimed = other == kNone;
    bool same = !claimed && edge_of(claimed ? h : other) == edge;
    if (same) before = atomicExchange(table[slot], h);
    searching = !claimed && !same;
    ++probes;
    slot = probes == kLocalProbes ? scale_to(scramble(edge.x ^ scramble(edge.y)), params.slots)
                                  : (slot + 1 == params.slots ? 0 : slot + 1);
  }
  next[h] = before;
}
