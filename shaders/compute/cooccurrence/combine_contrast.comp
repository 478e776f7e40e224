// combine_contrast.comp — One thread per chunk of partial results: their sum, in order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CombineParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) buffer Totals { double totals[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  double sum = 0.0LF;
  for (uint i = chunk.first; i < chunk.first + chunk.count; ++i) sum += totals[params.first_input + i];
  totals[params.first_output + index] = sum;
}
