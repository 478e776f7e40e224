// combine_topology.comp — One thread per chunk of partial results: their sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { TopologyTotals totals[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  TopologyTotals sum = TopologyTotals(0, 0, 0, 0);
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i) {
    TopologyTotals part = totals[params.first_input + i];
    sum.components += part.components;
    sum.isolated += part.isolated;
    sum.boundary_edges += part.boundary_edges;
    sum.non_manifold_edges += part.non_manifold_edges;
  }
  totals[params.first_output + index] = sum;
}
