// sort_keys_of_directions.comp — One thread per shared half-edge: the sort key (edge, direction about it), and the least height of the edge.
//
// A height is a positive double, whose bits order like an integer; its high and low words are lowered in two dispatches (the second
// looks at triangles that reached the least high word), because 64-bit atomics are not to be relied on.
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
layout(binding = 6, scalar) readonly buffer Heights { double heights[]; };
layout(binding = 7, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 8, scalar) readonly buffer Begins { uint begins[]; };
layout(binding = 9, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 10, scalar) writeonly buffer High { uint high[]; };
layout(binding = 11, scalar) writeonly buffer Values { uint values[]; };
layout(binding = 12, scalar) buffer HeightHigh { uint height_high[]; };
#include "compute/lib/threads.glsl"
#define EDGES_OF_CORNERS
#include "compute/lib/half_edges.glsl"
#include "compute/lib/positions.glsl"
#include "compute/lib/edge_frame.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint h = half_edges[place];
  uint64_t angle = quantised_angle(direction_about_edge(h), params.angle_bits);
  uint64_t key = (uint64_t(begins[place]) << params.angle_bits) | angle;
  low[place] = uint(key & 0xFFFFFFFFul);
  high[place] = uint(key >> 32);
  values[place] = h;
  atomicMin(height_high[begins[place]], unpackDouble2x32(heights[h / 3]).y);
}
