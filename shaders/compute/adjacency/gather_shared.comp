// gather_shared.comp — One thread per half-edge: lists those on edges with more than two triangles, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) buffer Cursor { uint cursor; };
layout(binding = 2, scalar) writeonly buffer Values { uint values[]; };
#include "compute/lib/threads.glsl"
#include "compute/adjacency/find_shared.glsl"

void main() {
  uint h = global_thread();
  if (h >= params.count) return;
  uint members = shared_through(h);
  if (members == 0) return;
  uint place = atomicAdd(cursor, members);
  values[place] = h;
  if (members == 2) values[place + 1] = twin[h];
}
