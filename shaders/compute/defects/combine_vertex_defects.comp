// combine_vertex_defects.comp — One thread per chunk of partial results: their sum and common box.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
#include "interface/defects.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { VertexDefects totals[]; };
#include "compute/lib/threads.glsl"
#include "compute/defects/vertex_totals.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  VertexDefects sum = no_vertex();
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i) {
    VertexDefects part = totals[params.first_input + i];
    for (uint kind = 0; kind < kVertexKinds; ++kind) sum.counts[kind] += part.counts[kind];
    include_place(sum, uvec3(part.low[0], part.low[1], part.low[2]), uvec3(part.high[0], part.high[1], part.high[2]));
  }
  totals[params.first_output + index] = sum;
}
