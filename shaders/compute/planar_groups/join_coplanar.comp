// join_coplanar.comp — One thread per triangle: unites it with coplanar neighbours across manifold edges.
//
// The triangle whose half-edge has the higher index does the test. Where both run along the edge in the same direction, one of them is
// wound the other way round and its normal is flipped first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { JoinParams params; };
layout(binding = 0, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 1, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 2, scalar) readonly buffer Totals { GeometryTotals geometry[]; };
layout(binding = 3, scalar) readonly buffer NormalX { double normal_x[]; };
layout(binding = 4, scalar) readonly buffer NormalY { double normal_y[]; };
layout(binding = 5, scalar) readonly buffer NormalZ { double normal_z[]; };
layout(binding = 6, scalar) readonly buffer Heights { double heights[]; };
layout(binding = 7, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 8, scalar) coherent buffer Parent { uint parent[]; };
#include "compute/lib/threads.glsl"
#define EDGES_OF_CORNERS
#include "compute/lib/half_edges.glsl"
#include "compute/lib/union_find.glsl"
#include "compute/lib/planarity.glsl"

dvec3 normal_of(uint t) { return dvec3(normal_x[t], normal_y[t], normal_z[t]); }

bool coplanar(uint t, uint other, bool flipped, double largest_coordinate) {
  dvec3 a = normal_of(t), b = normal_of(other);
  if (flipped) b = -b;
  dvec3 normal = dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  double sine = sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
  double cosine = a.x * b.x + a.y * b.y + a.z * b.z;
  double tolerance = tolerance_of(largest_coordinate, heights[t], heights[other]);
  return params.alpha + tolerance >= kPi ||
         within_angle(sine, cosine, sine_and_cosine(params.sin_alpha, params.cos_alpha, tolerance));
}

void main() {
  uint t = global_thread();
  if (t >= params.count) return;
  double largest_coordinate = geometry[mesh_of[t]].largest_coordinate;
  // The edges to test as bits, so that threads that run in step go through as many rounds as the busiest of them has edges.
  uint edges = 0;
  for (uint c = 0; c < 3; ++c) edges |= is_manifold(twin[3 * t + c]) && twin[3 * t + c] < 3 * t + c ? 1u << c : 0u;
  while (edges != 0) {
    uint h = 3 * t + uint(findLSB(edges));
    edges &= edges - 1;
    uint across = twin[h];
    bool flipped = corners[h] == corners[across];
    uint other = across / 3;
    bool same_plane = coplanar(t, other, flipped, largest_coordinate);
    // A loop instead of a branch: see sum_contrast.comp.
    for (bool joins = same_plane; joins; joins = false) unite(t, other);
  }
}
