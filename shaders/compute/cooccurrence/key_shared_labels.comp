// key_shared_labels.comp — One thread per shared half-edge: sort key (edge, label of the triangle).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedLabelParams params; };
layout(binding = 0, scalar) readonly buffer Labels { uint labels[]; };
layout(binding = 1, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 2, scalar) readonly buffer Begins { uint begins[]; };
layout(binding = 3, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 4, scalar) writeonly buffer High { uint high[]; };
layout(binding = 5, scalar) writeonly buffer Values { uint values[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint64_t key = (uint64_t(begins[place]) << params.label_bits) | uint64_t(labels[half_edges[place] / 3]);
  low[place] = uint(key & 0xFFFFFFFFul);
  high[place] = uint(key >> 32);
  values[place] = place;
}
