// triangle_table.glsl — Triangles by their three corners in an open-addressed table of triangle indices.
//
// Needs buffers corners, twin and table.
#ifndef SCENE_ANALYZER_DEFECTS_TRIANGLE_TABLE
#define SCENE_ANALYZER_DEFECTS_TRIANGLE_TABLE
#include "compute/lib/half_edges.glsl"
#include "compute/lib/hashing.glsl"

// Welded corners, ascending.
uvec3 sorted_corners(uint t) {
  uint a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
  uint low = min(a, min(b, c)), high = max(a, max(b, c));
  return uvec3(low, a ^ b ^ c ^ low ^ high, high);
}

// Triangles of the same corners share three edges. On an edge of two triangles the other one is the twin's, so only
// triangles whose edges all have more need the table.
bool needs_table(uint t) {
  return is_shared(twin[3 * t]) && is_shared(twin[3 * t + 1]) && is_shared(twin[3 * t + 2]);
}

// Where a triangle is looked for after so many other places. Each is another function of the corners, so that those
// which meet at one place, by chance or by the file's design, part at the next.
uint slot_of(uvec3 key, uint probes, uint slots) {
  return scale_to(scramble(key.x ^ scramble(key.y ^ scramble(key.z ^ scramble(probes)))), slots);
}

#endif
