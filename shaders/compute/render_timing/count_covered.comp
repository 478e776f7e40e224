// count_covered.comp — One thread per pixel: how many pixels have something drawn on them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/render_timing.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { CountCoveredParams params; };
layout(binding = 0, scalar) readonly buffer Picture { uint rgba[]; };
layout(binding = 1, scalar) buffer Counts { uint counts[]; };
#include "compute/lib/threads.glsl"

shared uint here;  // of this workgroup

void main() {
  if (gl_LocalInvocationID.x == 0) here = 0;
  barrier();
  uint pixel = global_thread();
  if (pixel < params.pixels && rgba[pixel] >> 24 != 0) atomicAdd(here, 1);  // integers: in any order
  barrier();
  if (gl_LocalInvocationID.x == 0 && here > 0) atomicAdd(counts[params.counter], here);
}
