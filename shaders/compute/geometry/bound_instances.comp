// bound_instances.comp — One thread per (instance, axis, side): the exact world bound of its kept triangles.
//
// Walks the chunks of the mesh and looks into those alone whose own box, carried into the world, reaches beyond the best so far.
// bounds[6 i + 2 axis + side], side 0 the lower bound.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { InstanceBoundsParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 2, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 3, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 4, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 5, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 6, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 7, scalar) readonly buffer Totals { GeometryTotals totals[]; };
layout(binding = 8, scalar) readonly buffer Instances { InstanceRecord instances[]; };
layout(binding = 9, scalar) writeonly buffer Bounds { double bounds[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"

// World coordinate of p along the axis, negated for the lower side so that both sides look for a maximum.
double reach(dvec3 p, dvec3 row, double offset, double sign) {
  precise double coordinate = row.x * p.x + row.y * p.y + row.z * p.z + offset;
  return sign * coordinate;
}

double reach_of_box(uint chunk, dvec3 row, double offset, double sign) {
  dvec3 low = dvec3(totals[chunk].low[0], totals[chunk].low[1], totals[chunk].low[2]);
  dvec3 high = dvec3(totals[chunk].high[0], totals[chunk].high[1], totals[chunk].high[2]);
  dvec3 corner = dvec3(sign * row.x > 0.0LF ? high.x : low.x, sign * row.y > 0.0LF ? high.y : low.y,
                       sign * row.z > 0.0LF ? high.z : low.z);
  double farthest = reach(corner, row, offset, sign);
  // Room for rounding, so that a box never promises less than a corner inside delivers.
  return farthest + 1e-14LF * (abs(farthest) + abs(offset));
}

void main() {
  uint index = global_thread();
  if (index >= 6 * params.instance_count) return;
  uint instance = index / 6, axis = index % 6 / 2;
  double sign = index % 2 == 0 ? -1.0LF : 1.0LF;
  dvec3 row = dvec3(instances[instance].world[4 * axis], instances[instance].world[4 * axis + 1],
                    instances[instance].world[4 * axis + 2]);
  double offset = instances[instance].world[4 * axis + 3];
  double best = -1.7e308LF;
  uint end = instances[instance].first_chunk + instances[instance].chunk_count;
  for (uint chunk = instances[instance].first_chunk; chunk < end; ++chunk) {
    bool worthwhile = totals[chunk].kept > 0 && reach_of_box(chunk, row, offset, sign) > best;
    uint stop = worthwhile ? chunks[chunk].first + chunks[chunk].count : 0;
    for (uint t = chunks[chunk].first; t < stop; ++t) {
      for (uint c = 0; c < 3; ++c) {
        double candidate = reach(local_position(corners[3 * t + c]), row, offset, sign);
        best = areas[t] > 0.0LF ? max(best, candidate) : best;
      }
    }
  }
  bounds[index] = sign * best;
}
