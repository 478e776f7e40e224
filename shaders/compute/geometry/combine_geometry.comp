// combine_geometry.comp — One thread per chunk of partial results: their sum, in order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { GeometryTotals totals[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/geometry_totals.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  GeometryTotals sum = no_geometry();
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i) add_totals(sum, totals[params.first_input + i]);
  totals[params.first_output + index] = sum;
}
