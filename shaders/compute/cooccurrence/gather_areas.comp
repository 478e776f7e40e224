// gather_areas.comp — One thread per sorted place: the area that belongs there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(binding = 2, scalar) writeonly buffer Sorted { double sorted[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place < params.count) sorted[place] = areas[order[place]];
}
