// half_edges.glsl — Half-edge arithmetic. Needs buffer corners where EDGES_OF_CORNERS is defined.
#ifndef SCENE_ANALYZER_LIB_HALF_EDGES
#define SCENE_ANALYZER_LIB_HALF_EDGES

bool is_shared(uint twin) { return twin != kNone && (twin & kShared) != 0; }
bool is_manifold(uint twin) { return (twin & kShared) == 0; }

#ifdef EDGES_OF_CORNERS
uint next_in_triangle(uint h) { return h % 3 == 2 ? h - 2 : h + 1; }
uint opposite_corner(uint h) { return h % 3 == 0 ? h + 2 : h - 1; }
// Its two vertices, lower index first.
uvec2 edge_of(uint h) {
  uint a = corners[h], b = corners[next_in_triangle(h)];
  return uvec2(min(a, b), max(a, b));
}
#endif

#endif
