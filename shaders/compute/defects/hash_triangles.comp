// hash_triangles.comp — One thread per triangle: where all its edges have more than two triangles, finds or claims the slot of
// its corners.
//
// table[slot] ends as the lowest triangle with those corners, whatever the order of threads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
#include "interface/defects.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { RepeatParams params; };
layout(binding = 0, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 1, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 2, scalar) coherent buffer Table { uint table[]; };
#include "compute/lib/threads.glsl"
#include "compute/defects/triangle_table.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles || !needs_table(t)) return;
  uvec3 key = sorted_corners(t);
  uint probes = 0;
  bool searching = true;
  while (searching) {
    uint slot = slot_of(key, probes, params.slots);
    uint other = table[slot];
    if (other == kNone) other = atomicCompSwap(table[slot], kNone, t);
    bool claimed = other == kNone;
    bool same = !claimed && sorted_corners(claimed ? t : other) == key;
    if (same) atomicMin(table[slot], t);
    searching = !claimed && !same;
    ++probes;
  }
}
