// values[i] = i + offset, for i < count; counted[0] = how many threads ran at all, surplus included.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "parameters.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { WriteIndexParams params; };
layout(set = 0, binding = 0, scalar) writeonly buffer Values { uint values[]; };
layout(set = 0, binding = 1, scalar) buffer Counted { uint counted[]; };
#include "compute/lib/threads.glsl"

void main() {
  const uint i = global_thread();
  atomicAdd(counted[0], 1);
  if (i < params.count) values[i] = i + params.offset;
}
