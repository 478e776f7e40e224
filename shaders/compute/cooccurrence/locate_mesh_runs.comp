// locate_mesh_runs.comp — One thread per mesh, and one more: the first run of its shared edges. Shared half-edges are listed by edge, and so by mesh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { MeshRunParams params; };
layout(binding = 0, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 1, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 2, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 3, scalar) writeonly buffer FirstRuns { uint first_runs[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint mesh = global_thread();
  if (mesh > params.meshes) return;
  uint low = 0, high = params.count;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (mesh_of[half_edges[middle] / 3] < mesh) low = middle + 1; else high = middle;
  }
  first_runs[mesh] = starts[low];
}
