// hash_half_edges.comp — One thread per half-edge: threads the half-edges of each edge onto a list, table[slot] -> next -> next.
//
// Half-edges of one edge find each other through an open-addressed table of half-edge indices that compares the two vertices. The order of a list
// depends on the order of threads; nothing that is kept does.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { HashParams params; };
layout(binding = 0, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 1, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 2, scalar) coherent buffer Table { uint table[]; };
layout(binding = 3, scalar) writeonly buffer Next { uint next[]; };
#include "compute/lib/threads.glsl"
#define EDGES_OF_CORNERS
#include "compute/lib/half_edges.glsl"
#include "compute/lib/edge_table.glsl"

void main() {
  uint h = global_thread();
  if (h >= params.half_edges) return;
  uvec2 edge = edge_of(h);
  uint slot = first_slot(edge, params.slots, params.slots_per_vertex);
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
    slot = next_slot(slot, probes, edge, params.slots);
  }
  next[h] = before;
}
