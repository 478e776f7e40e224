// start_components.comp — One thread per triangle: hangs it below its lowest neighbour.
//
// A forest that already holds most of every component (compare Jaiganesh and Burtscher, ECL-CC, 2018); join_components.comp does the rest.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { TriangleParams params; };
layout(binding = 0, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 1, scalar) readonly buffer Shared { uint shared_half_edges[]; };
layout(binding = 2, scalar) writeonly buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#include "compute/adjacency/neighbours.glsl"

void main() {
  uint t = global_thread();
  if (t < params.triangles) parent[t] = lowest_neighbour(t);
}
