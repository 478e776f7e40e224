// link_directions.comp — One thread per shared half-edge: unites its triangle with the coplanar ones of the same edge.
//
// Two triangles are coplanar when one's direction about the edge and the opposite of the other's enclose at most alpha + tolerance. With
// directions sorted, the partners of a triangle are one interval (or two, where it wraps): the triangle joins the first of it, and `steps` notes
// that all of the interval hang together (+1 at its first, -1 at its last place; a scan turns that into links between neighbours in the list).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { JoinParams params; };
layout(binding = 0, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 1, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 2, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 3, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 4, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 5, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 6, scalar) readonly buffer Totals { GeometryTotals geometry[]; };
layout(binding = 7, scalar) readonly buffer HalfEdges { uint half_edges[]; };  // sorted by (edge, direction)
layout(binding = 8, scalar) readonly buffer Low { uint low[]; };
layout(binding = 9, scalar) readonly buffer High { uint high[]; };
layout(binding = 10, scalar) readonly buffer Begins { uint begins[]; };
layout(binding = 11, scalar) readonly buffer Ends { uint ends[]; };
layout(binding = 12, scalar) readonly buffer HeightHigh { uint height_high[]; };
layout(binding = 13, scalar) readonly buffer HeightLow { uint height_low[]; };
layout(binding = 14, scalar) coherent buffer Parent { uint parent[]; };
layout(binding = 15, scalar) buffer Steps { uint steps[]; };
#include "compute/lib/threads.glsl"
#define EDGES_OF_CORNERS
#include "compute/lib/half_edges.glsl"
#include "compute/lib/positions.glsl"
#include "compute/lib/edge_frame.glsl"
#include "compute/lib/union_find.glsl"
#include "compute/lib/planarity.glsl"

uint64_t angle_at(uint place) {
  uint64_t key = (uint64_t(high[place]) << 32) | uint64_t(low[place]);
  return key & ((uint64_t(1) << params.angle_bits) - 1);
}

// First place in [begin, end) whose angle is not below (strict: is above) the given one.
uint search(uint begin, uint end, uint64_t angle, bool strict) {
  while (begin < end) {
    uint middle = begin + (end - begin) / 2;
    uint64_t found = angle_at(middle);
    if (found < angle || (strict && found == angle)) begin = middle + 1; else end = middle;
  }
  return begin;
}

void join_interval(uint triangle, uint first, uint last_plus_one) {
  if (first >= last_plus_one) return;
  unite(triangle, half_edges[first] / 3);
  atomicAdd(steps[first], 1u);
  atomicAdd(steps[last_plus_one - 1], 0xFFFFFFFFu);
}

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint h = half_edges[place];
  uint begin = begins[place], end = ends[place];
  double height = packDouble2x32(uvec2(height_low[begin], height_high[begin]));
  double tolerance = tolerance_of(geometry[mesh_of[h / 3]].largest_coordinate, height, height);
  if (params.alpha + tolerance >= kPi) {
    join_interval(h / 3, begin, end);
    return;
  }
  dvec2 bound = sine_and_cosine(params.sin_alpha, params.cos_alpha, tolerance);
  dvec2 opposite = -direction_about_edge(h);
  dvec2 turned_back = dvec2(opposite.x * bound.y + opposite.y * bound.x, opposite.y * bound.y - opposite.x * bound.x);
  dvec2 turned_on = dvec2(opposite.x * bound.y - opposite.y * bound.x, opposite.y * bound.y + opposite.x * bound.x);
  uint64_t from = quantised_angle(turned_back, params.angle_bits);
  uint64_t to = quantised_angle(turned_on, params.angle_bits);
  uint first = search(begin, end, from, false), last = search(begin, end, to, true);
  bool wraps = from > to;
  join_interval(h / 3, first, wraps ? end : last);
  if (wraps) join_interval(h / 3, begin, last);
}
