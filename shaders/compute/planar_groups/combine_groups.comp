// combine_groups.comp — One thread per chunk of partial results: their sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { PlanarTotals totals[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  PlanarTotals sum = PlanarTotals(0.0LF, 0, 0);
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i) {
    PlanarTotals part = totals[params.first_input + i];
    sum.squared_sizes += part.squared_sizes;
    sum.groups += part.groups;
    sum.largest = max(sum.largest, part.largest);
  }
  totals[params.first_output + index] = sum;
}
