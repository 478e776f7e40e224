// find_triangle_defects.comp — One thread per chunk: which defects its triangles have.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
#include "interface/defects.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { FindParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 2, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 3, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 4, scalar) readonly buffer Shared { uint shared_half_edges[]; };
layout(binding = 5, scalar) readonly buffer Table { uint table[]; };
layout(binding = 6, scalar) writeonly buffer Totals { TriangleDefects totals[]; };
layout(binding = 7, scalar) writeonly buffer Masks { TriangleMasks masks[]; };
#include "compute/lib/threads.glsl"
#include "compute/defects/triangle_table.glsl"

// The lowest triangle with the corners of t, which needs_table().
uint first_of_equal(uint t) {
  uvec3 key = sorted_corners(t);
  uint found = table[slot_of(key, 0, params.slots)];
  for (uint probes = 1; sorted_corners(found) != key; ++probes) found = table[slot_of(key, probes, params.slots)];
  return found;
}

// What one triangle adds to each count.
uint[kTriangleKinds] defects_of(uint t) {
  uint a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
  bool kept = areas[t] > 0.0LF;
  bool equal_corners = a == b || b == c || c == a;
  uint boundary = 0, non_manifold = 0, same_direction = 0;
  bool repeated = false;
  for (uint h = 3 * t; h < 3 * t + 3; ++h) {
    uint other = twin[h];
    bool alone = other == kNone, among_many = is_shared(other), paired = !alone && !among_many;
    boundary += alone ? 1 : 0;
    uint first = shared_half_edges[among_many ? other & ~kShared : 0];
    non_manifold += among_many && first == h ? 1 : 0;
    bool first_of_pair = paired && h < other;
    same_direction += first_of_pair && corners[other] == corners[h] ? 1 : 0;
    bool second_of_pair = paired && other < h;
    if (second_of_pair) repeated = repeated || sorted_corners(other / 3) == sorted_corners(t);
  }
  if (needs_table(t)) repeated = first_of_equal(t) != t;
  uint defects[kTriangleKinds];
  defects[0] = equal_corners ? 1 : 0;
  defects[1] = !kept && !equal_corners ? 1 : 0;
  defects[2] = repeated ? 1 : 0;
  defects[3] = non_manifold;
  defects[4] = kept ? boundary : 0;
  defects[5] = same_direction;
  defects[6] = kept && boundary == 3 ? 1 : 0;
  return defects;
}

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  TriangleDefects sum;
  for (uint kind = 0; kind < kTriangleKinds; ++kind) sum.counts[kind] = 0;
  for (uint word = 0; word < kMaskWords; ++word) {
    uint bits[kTriangleKinds];
    for (uint kind = 0; kind < kTriangleKinds; ++kind) bits[kind] = 0;
    uint begin = min(32 * word, chunk.count), end = min(32 * word + 32, chunk.count);
    for (uint i = begin; i < end; ++i) {
      uint defects[kTriangleKinds] = defects_of(chunk.first + i);
      for (uint kind = 0; kind < kTriangleKinds; ++kind) {
        sum.counts[kind] += defects[kind];
        bits[kind] |= (defects[kind] > 0 ? 1u : 0u) << (i % 32);
      }
    }
    for (uint kind = 0; kind < kTriangleKinds; ++kind) masks[index].words[kMaskWords * kind + word] = bits[kind];
  }
  totals[index] = sum;
}
