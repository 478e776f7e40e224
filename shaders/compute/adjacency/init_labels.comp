// init_labels.comp — One thread per triangle: every triangle is a set of its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) writeonly buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"

void main() {
  if (global_thread() < params.triangles) parent[global_thread()] = global_thread();
}
