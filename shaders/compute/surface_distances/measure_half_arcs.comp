// measure_half_arcs.comp — One thread per triangle: how far its centroid is from the midpoint of each of its edges.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/surface_distances.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ArcParams params; };
layout(binding = 0, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 1, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 2, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 3, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 4, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 5, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 6, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 7, scalar) writeonly buffer HalfArcs { double half_arcs[]; };  // of these triangles
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"

// |C - M| of the edge from a to b: C - M = (a + b + c) / 3 - (a + b) / 2, without the sums' rounding.
double half_arc(dvec3 a, dvec3 b, dvec3 c) {
  precise dvec3 to_centroid = ((c - a) + (c - b)) / 6.0LF;
  precise double squared =
      to_centroid.x * to_centroid.x + to_centroid.y * to_centroid.y + to_centroid.z * to_centroid.z;
  return sqrt(squared);
}

void main() {
  uint out_at = 3 * global_thread();
  if (global_thread() >= params.count) return;
  uint t = params.first + global_thread();
  uint mesh = mesh_of[t];
  dvec3 a = analysed_position(corners[3 * t], mesh);
  dvec3 b = analysed_position(corners[3 * t + 1], mesh);
  dvec3 c = analysed_position(corners[3 * t + 2], mesh);
  // Corners of degenerate triangles need not be finite; nothing leads over their edges.
  bool kept = areas[t] > 0.0LF;
  half_arcs[out_at] = kept ? half_arc(a, b, c) : 0.0LF;
  half_arcs[out_at + 1] = kept ? half_arc(b, c, a) : 0.0LF;
  half_arcs[out_at + 2] = kept ? half_arc(c, a, b) : 0.0LF;
}
