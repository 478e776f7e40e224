// bound_instances.comp — One thread per (instance, block of chunks, axis, side): the farthest world coordinate in the block.
//
// Looks into chunks alone whose box reaches beyond what probe_instances.comp has found for the instance.
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
layout(binding = 10, scalar) readonly buffer Reached { double reached[]; };
layout(binding = 11, scalar) writeonly buffer Bounds { double bounds[]; };  // negated on lower sides
#include "compute/lib/threads.glsl"
#include "compute/lib/positions.glsl"
#include "compute/geometry/instance_reach.glsl"

uint instance_of(uint output_index) {
  uint low = 0, high = params.instance_count;
  while (high - low > 1) {
    uint middle = (low + high) / 2;
    if (instances[middle].first_output <= output_index) low = middle; else high = middle;
  }
  return low;
}

void main() {
  uint index = global_thread();
  if (index >= 6 * params.output_count) return;
  uint instance = instance_of(index / 6);
  uint block = instances[instance].first_block + index / 6 - instances[instance].first_output;
  Direction d = direction_of(instance, index % 6);
  double best = reached[6 * instance + index % 6];
  uint last = reach_of_box(params.first_block + block, d) > best ? blocks[block].first + blocks[block].count : 0;
  for (uint chunk = blocks[block].first; chunk < last; ++chunk) {
    bool worthwhile = reach_of_box(chunk, d) > best;
    for (bool look = worthwhile; look; look = false) best = max(best, reach_of_chunk(chunk, d));
  }
  bounds[index] = best;
}
