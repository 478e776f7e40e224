// edge_table.glsl — Where an edge may lie in the table of half-edges.
//
// The first slots tried lie at a place proportional to the lower vertex: files list neighbours near each other, so these probes hit the cache. Where
// many edges crowd (a vertex of very many triangles, or vertices that welding left at the front of a large range), they would fill their surroundings: after every
// kLocalProbes probes the search goes on at another random place, so that no run of full slots is ever walked.
#ifndef SCENE_ANALYZER_LIB_EDGE_TABLE
#define SCENE_ANALYZER_LIB_EDGE_TABLE
#include "compute/lib/hashing.glsl"

uint first_slot(uvec2 edge, uint slots, double slots_per_vertex) {
  return min(uint(double(edge.x) * slots_per_vertex), slots - 1);
}

uint next_slot(uint slot, uint probes, uvec2 edge, uint slots) {
  uint elsewhere = scale_to(scramble(edge.x ^ scramble(edge.y ^ scramble(probes))), slots);
  return probes % kLocalProbes == 0 ? elsewhere : (slot + 1 == slots ? 0 : slot + 1);
}

#endif
