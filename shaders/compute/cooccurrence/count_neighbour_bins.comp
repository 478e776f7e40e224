// count_neighbour_bins.comp — One thread per half-edge of the window: the pair of bins of its triangle and of the neighbour, on edges with two triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { NeighbourBinParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 2, scalar) readonly buffer Labels { uint labels[]; };
layout(binding = 3, scalar) buffer Counters { uint counters[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/half_edges.glsl"
#include "compute/lib/wide_counters.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.count) return;
  uint h = params.first + index;
  uint other = twin[h];
  if (!is_manifold(other)) return;
  uint row = (mesh_of[h / 3] - params.first_mesh) * kBins + labels[h / 3];
  add_wide(row * kBins + labels[other / 3], uint64_t(1));
}
