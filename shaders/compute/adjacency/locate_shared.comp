// locate_shared.comp — One thread per shared half-edge: finds the slot of its edge and lowers it to the edge's lowest half-edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedParams params; };
layout(binding = 0, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 1, scalar) coherent buffer Table { uint table[]; };
layout(binding = 2, scalar) readonly buffer Values { uint values[]; };
layout(binding = 3, scalar) writeonly buffer Slots { uint slots[]; };
#include "compute/lib/threads.glsl"
#define EDGES_OF_CORNERS
#include "compute/lib/half_edges.glsl"
#include "compute/lib/edge_table.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint h = values[place];
  uvec2 edge = edge_of(h);
  uint slot = first_slot(edge, params.slots, params.slots_per_vertex);
  for (uint probes = 1; edge_of(table[slot]) != edge; ++probes) slot = next_slot(slot, probes, edge, params.slots);
  atomicMin(table[slot], h);
  slots[place] = slot;
}
