// weld_vertices.comp — One thread per vertex: finds or claims the slot of its coordinates in a hash table.
//
// table[slot] ends as the lowest vertex index with those coordinates, whatever the order of threads; slot_of[vertex] is that slot.
// -0 equals 0; a NaN equals nothing, so such vertices get a slot of their own by
// never comparing equal. Vertices of different meshes are different.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { WeldParams params; };
layout(binding = 0, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 1, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 2, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 3, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 4, scalar) coherent buffer Table { uint table[]; };
layout(binding = 5, scalar) writeonly buffer SlotOf { uint slot_of[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/hashing.glsl"

uint without_sign_of_zero(uint bits) { return bits == 0x80000000u ? 0u : bits; }
bool is_nan(uint bits) { return (bits & 0x7FFFFFFFu) > 0x7F800000u; }

// The mesh of a vertex: the last one that starts at or before it and is not empty.
uint mesh_of(uint vertex) {
  uint low = 0, high = params.mesh_count;
  while (high - low > 1) {
    uint middle = (low + high) / 2;
    if (meshes[middle].first_vertex <= vertex) low = middle; else high = middle;
  }
  return low;
}

void main() {
  uint vertex = global_thread();
  if (vertex >= params.vertex_count) return;
  uint x = without_sign_of_zero(position_x[vertex]);
  uint y = without_sign_of_zero(position_y[vertex]);
  uint z = without_sign_of_zero(position_z[vertex]);
  bool alone = is_nan(x) || is_nan(y) || is_nan(z);
  uint mesh = mesh_of(vertex);
  uint first = meshes[mesh].first_vertex;
  uint last = first + meshes[mesh].vertex_count;

  uint hash = alone ? scramble(vertex) : scramble(x ^ scramble(y ^ scramble(z ^ scramble(mesh))));
  uint slot = scale_to(hash, params.slots);
  uint found = 0;
  while (found == 0) {
    uint other = table[slot];
    if (other == kNone) other = atomicCompSwap(table[slot], kNone, vertex);
    if (other == kNone || other == vertex) {
      found = 1;
    } else if (other >= first && other < last && !alone && without_sign_of_zero(position_x[other]) == x &&
               without_sign_of_zero(position_y[other]) == y && without_sign_of_zero(position_z[other]) == z) {
      atomicMin(table[slot], vertex);
      found = 1;
    } else {
      slot = slot + 1 == params.slots ? 0 : slot + 1;
    }
  }
  slot_of[vertex] = slot;
}
