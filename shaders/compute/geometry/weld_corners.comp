// weld_corners.comp — One thread per chunk: indices within the mesh become welded vertex indices of the batch, in place;
// notes the mesh of each triangle, and which vertices the indices name.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ChunkParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 2, scalar) readonly buffer Representative { uint representative[]; };
layout(binding = 3, scalar) buffer Corners { uint corners[]; };
layout(binding = 4, scalar) writeonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 5, scalar) coherent buffer Referenced { uint referenced[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  uint base = meshes[chunk.mesh].first_vertex;
  for (uint t = chunk.first; t < chunk.first + chunk.count; ++t) {
    for (uint c = 0; c < 3; ++c) {
      uint vertex = base + corners[3 * t + c];
      corners[3 * t + c] = representative[vertex];
      uint bit = 1u << (vertex % 32);
      if ((referenced[vertex / 32] & bit) == 0u) atomicOr(referenced[vertex / 32], bit);
    }
    mesh_of[t] = chunk.mesh;
  }
}
