// probe_instances.comp — One thread per (instance, axis, side): a world coordinate that its kept triangles reach for sure.
//
// Follows the most promising block, and in it the most promising chunk: a good lower limit for bound_instances.comp to beat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { InstanceBoundsParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };    // level 0
layout(binding = 1, scalar) readonly buffer Blocks { Chunk blocks[]; };    // level 1
layout(binding = 2, scalar) readonly buffer Meshes { MeshRecord meshes[]; };
layout(binding = 3, scalar) readonly buffer X { uint position_x[]; };
layout(binding = 4, scalar) readonly buffer Y { uint position_y[]; };
layout(binding = 5, scalar) readonly buffer Z { uint position_z[]; };
layout(binding = 6, scalar) readonly buffer Corners { uint corners[]; };
layout(binding = 7, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 8, scalar) readonly buffer Totals { GeometryTotals totals[]; };
layout(binding = 9, scalar) readonly buffer Instances { InstanceRecord instances[]; };
layout(binding = 10, scalar) writeonly buffer Reached { double reached[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"
#include "compute/geometry/instance_reach.glsl"

// Of entries first .. first + count of the partial results, the one whose box reaches farthest.
uint farthest_box(uint first, uint count, Direction d) {
  uint best = first;
  double best_reach = kNowhere;
  for (uint i = first; i < first + count; ++i) {
    double candidate = reach_of_box(i, d);
    best = candidate > best_reach ? i : best;
    best_reach = max(best_reach, candidate);
  }
  return best;
}

void main() {
  uint index = global_thread();
  if (index >= 6 * params.instance_count) return;
  uint instance = index / 6;
  Direction d = direction_of(instance, index % 6);
  uint block = farthest_box(params.first_block + instances[instance].first_block, instances[instance].block_count, d) -
               params.first_block;
  reached[index] = reach_of_chunk(farthest_box(blocks[block].first, blocks[block].count, d), d);
}
