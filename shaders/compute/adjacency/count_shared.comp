// count_shared.comp — One thread per half-edge: how many lie on edges with more than two triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) buffer SharedCount { uint shared_count; };
#include "compute/lib/threads.glsl"
#include "compute/adjacency/find_shared.glsl"

void main() {
  uint h = global_thread();
  if (h >= params.count) return;
  uint members = shared_through(h);
  if (members > 0) atomicAdd(shared_count, members);
}
