// make_area_keys.comp — One thread per triangle: sort key (mesh, area) and the triangle itself.
//
// The key keeps the leading bits of the area's mantissa (34 or more): areas that agree in all of them differ by less than 6e-11, far less than
// the 1.2e-7 within which areas are one class.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { KeyParams params; };
layout(binding = 0, scalar) readonly buffer Areas { double areas[]; };
layout(binding = 1, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 2, scalar) writeonly buffer Low { uint low[]; };
layout(binding = 3, scalar) writeonly buffer High { uint high[]; };
layout(binding = 4, scalar) writeonly buffer Values { uint values[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  uvec2 words = unpackDouble2x32(areas[t]);
  uint64_t bits = (uint64_t(words.y) << 32) | uint64_t(words.x);
  uint64_t exponent = (bits >> 52) - uint64_t(params.least_exponent);
  uint64_t mantissa = (bits & ((uint64_t(1) << 52) - 1)) >> (52 - params.mantissa_bits);
  uint64_t key = (((uint64_t(mesh_of[t]) << params.exponent_bits) | exponent) << params.mantissa_bits) | mantissa;
  if (!(areas[t] > 0.0LF)) key = ~uint64_t(0);
  low[t] = uint(key & 0xFFFFFFFFul);
  high[t] = uint(key >> 32);
  values[t] = t;
}
