// measure_triangles.comp — One thread per chunk: areas, degenerate triangles, and the chunk's totals.
//
// A degenerate triangle (two equal corners, a coordinate that is not finite, or a height of at most 1e-6 of the longest edge) gets
// area 0, which no kept triangle has: later kernels tell it by that.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ChunkParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 2, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 3, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 4, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 5, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 6, scalar) writeonly buffer Areas { double areas[]; };
layout(binding = 7, scalar) writeonly buffer Totals { GeometryTotals totals[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"
#include "compute/lib/triangles.glsl"
#include "compute/lib/geometry_totals.glsl"

double largest(dvec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  GeometryTotals sum = no_geometry();
  for (uint t = chunk.first; t < chunk.first + chunk.count; ++t) {
    uint i = corners[3 * t], j = corners[3 * t + 1], k = corners[3 * t + 2];
    dvec3 local_a = local_position(i), local_b = local_position(j), local_c = local_position(k);
    dvec3 a = transform(local_a, chunk.mesh), b = transform(local_b, chunk.mesh), c = transform(local_c, chunk.mesh);
    TriangleShape shape = shape_of(a, b, c);
    double reach = max(largest(a), max(largest(b), largest(c)));
    // The last comparison is written so that NaN and infinity count as degenerate.
    bool kept = i != j && j != k && k != i && is_finite(i) && is_finite(j) && is_finite(k) && reach <= 1e300LF &&
                shape.twice_area > 1e-6LF * shape.longest_edge * shape.longest_edge;
    double area = kept ? 0.5LF * shape.twice_area : 0.0LF;
    areas[t] = area;
    add_triangle(sum, kept, area, reach, vec3(min(local_a, min(local_b, local_c))),
                 vec3(max(local_a, max(local_b, local_c))));
  }
  totals[index] = sum;
}
