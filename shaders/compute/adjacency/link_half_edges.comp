// link_half_edges.comp — One thread per slot of the table: the list of an edge's half-edges becomes their twins, in place.
//
// An edge with k > 2 triangles is walked by one thread, k steps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { LinkParams params; };
layout(binding = 0, scalar) readonly buffer Table { uint table[]; };
layout(binding = 1, scalar) buffer Twin { uint twin[]; };
layout(binding = 2, scalar) buffer SharedCount { uint shared_count; };
#include "compute/lib/threads.glsl"

void main() {
  uint slot = global_thread();
  if (slot >= params.slots) return;
  uint head = table[slot];
  uint members = 0, lowest = kNone, last = kNone;
  for (uint h = head; h != kNone; h = twin[h]) {
    ++members;
    lowest = min(lowest, h);
    last = h;
  }
  if (members == 2) twin[last] = head;
  for (uint h = members > 2 ? head : kNone; h != kNone;) {
    uint following = twin[h];
    twin[h] = kShared | lowest;
    h = following;
  }
  if (members > 2) atomicAdd(shared_count, members);
}
