// pair_neighbours.comp — One thread per half-edge of the window: the pair of labels of its triangle and of the neighbour, on edges with two triangles;
// elsewhere all ones, which no pair has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { PairParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) readonly buffer Labels { uint labels[]; };
layout(binding = 2, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 3, scalar) writeonly buffer High { uint high[]; };
layout(binding = 4, scalar) writeonly buffer Values { uint values[]; };
layout(binding = 5, scalar) writeonly buffer Weights { uint64_t weights[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/half_edges.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.count) return;
  uint h = params.first + index;
  uint other = twin[h];
  uint64_t key = ~uint64_t(0);
  if (is_manifold(other)) key = (uint64_t(labels[h / 3]) << params.label_bits) | uint64_t(labels[other / 3]);
  low[index] = uint(key & 0xFFFFFFFFul);
  high[index] = uint(key >> 32);
  values[index] = index;
  weights[index] = uint64_t(1);
}
