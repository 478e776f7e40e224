// key_shared.comp — One thread per shared half-edge: its sort key (lowest half-edge of the edge, half-edge); the slot becomes the former.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedParams params; };
layout(binding = 0, scalar) readonly buffer Table { uint table[]; };
layout(binding = 1, scalar) readonly buffer Values { uint values[]; };
layout(binding = 2, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 3, scalar) buffer High { uint high[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  low[place] = values[place];
  high[place] = table[high[place]];
}
