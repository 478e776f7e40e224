// link_half_edges.comp — One thread per slot of the table: lists of two half-edges become twins of each other, in place.
//
// Longer lists are left as they are (find_shared.glsl recognises them): walking one would take as many steps as it has members, and software
// devices end a thread's loops after 65535 steps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { LinkParams params; };
layout(binding = 0, scalar) readonly buffer Table { uint table[]; };
layout(binding = 1, scalar) buffer Twin { uint twin[]; };
layout(binding = 2, scalar) buffer SharedEdges { uint shared_edges; };  // edges with a longer list
#include "compute/lib/threads.glsl"

void main() {
  uint slot = global_thread();
  if (slot >= params.slots) return;
  uint head = table[slot];
  uint second = head == kNone ? kNone : twin[head];
  uint third = second == kNone ? kNone : twin[second];
  if (second != kNone && third == kNone) twin[second] = head;
  if (third != kNone) atomicAdd(shared_edges, 1);
}
