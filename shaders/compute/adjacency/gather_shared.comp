// gather_shared.comp — One thread per half-edge: lists those on edges with more than two triangles, with sort keys (lowest half-edge of
// the edge, half-edge), so that the sorted list does not depend on the order of threads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { GatherParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) buffer Cursor { uint cursor; };
layout(binding = 2, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 3, scalar) writeonly buffer High { uint high[]; };
layout(binding = 4, scalar) writeonly buffer Values { uint values[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint h = global_thread();
  if (h >= params.half_edges) return;
  uint other = twin[h];
  if (other == kNone || (other & kShared) == 0) return;
  uint place = atomicAdd(cursor, 1);
  low[place] = h;
  high[place] = other & ~kShared;
  values[place] = h;
}
