// find_vertex_defects.comp — One thread per chunk of vertices: which of them no triangle uses, are not finite, or welding
// merges into another; and the box of the others that triangles use.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/defects.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { FindParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 2, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 3, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 4, scalar) readonly buffer Representative { uint representative[]; };
layout(binding = 5, scalar) readonly buffer Referenced { uint referenced[]; };
layout(binding = 6, scalar) writeonly buffer Totals { VertexDefects totals[]; };
layout(binding = 7, scalar) writeonly buffer Masks { VertexMasks masks[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/float_bits.glsl"
#include "compute/defects/vertex_totals.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  VertexDefects sum = no_vertex();
  for (uint word = 0; word < kMaskWords; ++word) {
    uint bits[kVertexKinds];
    for (uint kind = 0; kind < kVertexKinds; ++kind) bits[kind] = 0;
    uint begin = min(32 * word, chunk.count), end = min(32 * word + 32, chunk.count);
    for (uint i = begin; i < end; ++i) {
      uint v = chunk.first + i;
      uvec3 place = uvec3(position_x[v], position_y[v], position_z[v]);
      bool finite = is_finite_bits(place.x) && is_finite_bits(place.y) && is_finite_bits(place.z);
      bool used = (referenced[v / 32] >> (v % 32) & 1u) != 0u;
      uvec3 ordered = uvec3(ordered_bits(place.x), ordered_bits(place.y), ordered_bits(place.z));
      if (used && finite) include_place(sum, ordered, ordered);
      bits[0] |= (used ? 0u : 1u) << (i % 32);
      bits[1] |= (finite ? 0u : 1u) << (i % 32);
      bits[2] |= (representative[v] == v ? 0u : 1u) << (i % 32);
    }
    for (uint kind = 0; kind < kVertexKinds; ++kind) {
      sum.counts[kind] += bitCount(bits[kind]);
      masks[index].words[kMaskWords * kind + word] = bits[kind];
    }
  }
  totals[index] = sum;
}
