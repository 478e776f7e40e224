// flatten_labels.comp — One thread per triangle: its label becomes the lowest triangle of its set.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/union_find.glsl"

void main() {
  uint t = global_thread();
  if (t < params.triangles) parent[t] = find_root(t);
}
