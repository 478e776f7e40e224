// edge_frame.glsl — Around an edge with many triangles every triangle is a direction. Needs buffers corners, mesh_of and positions.glsl, half_edges.glsl.
//
// The frame depends on the edge alone, so that all its triangles agree. Angles are held as pseudo-angles: a function that grows with
// the angle, has 4 for a full turn and needs no arc tangent; as integers they wrap and compare exactly.
#ifndef SCENE_ANALYZER_LIB_EDGE_FRAME
#define SCENE_ANALYZER_LIB_EDGE_FRAME

dvec3 cross_product(dvec3 a, dvec3 b) {
  return dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

double length_of(dvec3 v) { return sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// The triangle's unit direction about its edge, in the edge's frame.
dvec2 direction_about_edge(uint h) {
  uint mesh = mesh_of[h / 3];
  uvec2 edge = edge_of(h);
  dvec3 a = analysed_position(edge.x, mesh);
  dvec3 axis = analysed_position(edge.y, mesh) - a;
  dvec3 apart = analysed_position(corners[opposite_corner(h)], mesh) - a;
  dvec3 size = abs(axis);
  dvec3 helper = size.x <= size.y && size.x <= size.z ? dvec3(1, 0, 0) : (size.y <= size.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1));
  dvec3 u = cross_product(axis, helper);
  u /= length_of(u);
  dvec3 w = cross_product(axis, u);
  w /= length_of(w);
  dvec2 direction = dvec2(u.x * apart.x + u.y * apart.y + u.z * apart.z, w.x * apart.x + w.y * apart.y + w.z * apart.z);
  return direction / sqrt(direction.x * direction.x + direction.y * direction.y);
}

// [0, 2^bits), wrapping.
uint64_t quantised_angle(dvec2 direction, uint bits) {
  double p = direction.y / (abs(direction.x) + abs(direction.y));
  double turn = direction.x >= 0.0LF ? (direction.y >= 0.0LF ? p : 4.0LF + p) : 2.0LF - p;
  uint64_t steps = uint64_t(turn * 0.25LF * double(uint64_t(1) << bits) + 0.5LF);
  return steps & ((uint64_t(1) << bits) - 1);
}

#endif
