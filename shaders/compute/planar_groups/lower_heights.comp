// lower_heights.comp — One thread per shared half-edge: the low word of the least height of its edge (see sort_keys_of_directions.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/planar_groups.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { JoinParams params; };
layout(binding = 0, scalar) readonly buffer Heights { double heights[]; };
layout(binding = 1, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 2, scalar) readonly buffer Begins { uint begins[]; };
layout(binding = 3, scalar) readonly buffer HeightHigh { uint height_high[]; };
layout(binding = 4, scalar) buffer HeightLow { uint height_low[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uvec2 height = unpackDouble2x32(heights[half_edges[place] / 3]);
  if (height.y == height_high[begins[place]]) atomicMin(height_low[begins[place]], height.x);
}
