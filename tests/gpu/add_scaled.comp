// target[i] += 3 * source[i]; every dispatch depends on the one before.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/types.h"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1, scalar) buffer Target { uint target[]; };
#include "compute/lib/threads.glsl"

void main() {
  const uint i = global_thread();
  if (i < target.length() && i < source.length()) target[i] += 3 * source[i];
}
