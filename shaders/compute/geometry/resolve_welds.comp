// resolve_welds.comp — One thread per vertex: slot of its coordinates -> lowest vertex index there, in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ResolveParams params; };
layout(binding = 0, scalar) readonly buffer Table { uint table[]; };
layout(binding = 1, scalar) buffer Representative { uint representative[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint vertex = global_thread();
  if (vertex >= params.vertex_count) return;
  representative[vertex] = table[representative[vertex]];
}
