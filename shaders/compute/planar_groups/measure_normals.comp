// measure_normals.comp — One thread per triangle: unit normal and least height, in double. Degenerate triangles get zeros.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { NormalParams params; };
layout(binding = 0, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 1, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 2, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 3, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 4, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 5, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 6, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 7, scalar) writeonly buffer NormalX { double normal_x[]; };
layout(binding = 8, scalar) writeonly buffer NormalY { double normal_y[]; };
layout(binding = 9, scalar) writeonly buffer NormalZ { double normal_z[]; };
layout(binding = 10, scalar) writeonly buffer Heights { double heights[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"
#include "compute/lib/triangles.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  uint mesh = mesh_of[t];
  TriangleShape shape = shape_of(analysed_position(corners[3 * t], mesh), analysed_position(corners[3 * t + 1], mesh),
                                 analysed_position(corners[3 * t + 2], mesh));
  bool kept = areas[t] > 0.0LF;
  normal_x[t] = kept ? shape.normal.x / shape.twice_area : 0.0LF;
  normal_y[t] = kept ? shape.normal.y / shape.twice_area : 0.0LF;
  normal_z[t] = kept ? shape.normal.z / shape.twice_area : 0.0LF;
  heights[t] = kept ? least_height(shape) : 0.0LF;
}
