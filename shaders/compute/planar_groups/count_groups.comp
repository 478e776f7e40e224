// count_groups.comp — One thread per chunk: adds each triangle to the size of its group. Runs of one group cost one atomic addition.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SizeParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 2, scalar) readonly buffer Labels { uint labels[]; };
layout(binding = 3, scalar) buffer Sizes { uint sizes[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  uint first = chunks[index].first, last = first + chunks[index].count;
  uint group = labels[first];
  uint run = 0;
  for (uint t = first; t < last; ++t) {
    uint label = labels[t];
    if (label != group) {
      atomicAdd(sizes[group], run);
      group = label;
      run = 0;
    }
    run += areas[t] > 0.0LF ? 1 : 0;
  }
  atomicAdd(sizes[group], run);
}
