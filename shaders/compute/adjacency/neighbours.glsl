// neighbours.glsl — Who is behind a half-edge. Needs buffers twin and shared_half_edges.
//
// On a shared edge everybody's neighbour is the first of the edge's list: that joins what the edge joins, at k steps, not k^2.
#ifndef SCENE_ANALYZER_ADJACENCY_NEIGHBOURS
#define SCENE_ANALYZER_ADJACENCY_NEIGHBOURS
#include "compute/lib/half_edges.glsl"

uint neighbour_across(uint h, uint t) {
  uint other = twin[h];
  bool among_many = is_shared(other);
  uint first = shared_half_edges[among_many ? other & ~kShared : 0];
  return among_many ? first / 3 : (other == kNone ? t : other / 3);
}

uint lowest_neighbour(uint t) {
  return min(min(t, neighbour_across(3 * t, t)), min(neighbour_across(3 * t + 1, t), neighbour_across(3 * t + 2, t)));
}

#endif
