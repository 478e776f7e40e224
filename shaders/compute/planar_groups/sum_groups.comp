// sum_groups.comp — One thread per chunk: groups, squared sizes and largest group, each counted at the group's lowest triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SizeParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Sizes { uint sizes[]; };
layout(binding = 2, scalar) writeonly buffer Totals { PlanarTotals totals[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  uint first = chunks[index].first, last = first + chunks[index].count;
  PlanarTotals sum = PlanarTotals(0.0LF, 0, 0);
  for (uint t = first; t < last; ++t) {
    uint size = sizes[t];
    sum.squared_sizes += size > 1 ? double(size) * double(size) : 0.0LF;
    sum.groups += size > 0 ? 1 : 0;
    sum.largest = max(sum.largest, size);
  }
  totals[index] = sum;
}
