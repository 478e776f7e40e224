// sum_topology.comp — One thread per chunk: components, isolated triangles, boundary and non-manifold edges.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TopologyParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 2, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 3, scalar) readonly buffer Labels { uint labels[]; };
layout(binding = 4, scalar) readonly buffer Shared { uint shared_half_edges[]; };
layout(binding = 5, scalar) writeonly buffer Totals { TopologyTotals totals[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/half_edges.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  TopologyTotals sum = TopologyTotals(0, 0, 0, 0);
  for (uint t = chunk.first; t < chunk.first + chunk.count; ++t) {
    bool kept = areas[t] > 0.0LF;
    uint boundary = 0, first_of_shared = 0;
    for (uint h = 3 * t; h < 3 * t + 3; ++h) {
      boundary += twin[h] == kNone ? 1 : 0;
      bool among_many = is_shared(twin[h]);
      uint first = shared_half_edges[among_many ? twin[h] & ~kShared : 0];
      first_of_shared += among_many && first == h ? 1 : 0;
    }
    sum.components += kept && labels[t] == t ? 1 : 0;
    sum.isolated += kept && boundary == 3 ? 1 : 0;
    sum.boundary_edges += kept ? boundary : 0;
    sum.non_manifold_edges += first_of_shared;
  }
  totals[index] = sum;
}
