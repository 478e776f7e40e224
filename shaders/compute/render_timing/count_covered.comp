// count_covered.comp — One thread per pixel: how many pixels have something drawn on them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "interface/render_timing.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CountCoveredParams params; };
layout(binding = 0, scalar) readonly buffer Picture { uint rgba[]; };
layout(binding = 1, scalar) buffer Counts { uint counts[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint pixel = global_thread();
  uint covered = pixel < params.pixels && rgba[pixel] >> 24 != 0 ? 1 : 0;
  uint together = subgroupAdd(covered);
  if (subgroupElect() && together > 0) atomicAdd(counts[params.counter], together);  // integers: in any order
}
