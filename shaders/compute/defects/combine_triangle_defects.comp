// combine_triangle_defects.comp — One thread per chunk of partial results: their sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
#include "interface/defects.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { TriangleDefects totals[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  TriangleDefects sum;
  for (uint kind = 0; kind < kTriangleKinds; ++kind) sum.counts[kind] = 0;
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i)
    for (uint kind = 0; kind < kTriangleKinds; ++kind) sum.counts[kind] += totals[params.first_input + i].counts[kind];
  totals[params.first_output + index] = sum;
}
