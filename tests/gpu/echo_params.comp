// One thread repeats its parameters into the buffer, so that the host sees what the shader read.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "parameters.h"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Block { WideParams params; };
layout(set = 0, binding = 0, scalar) writeonly buffer Sums { double sums[]; };

void main() {
  sums[0] = double(params.direction[0]) + params.direction[1] + params.direction[2];
  sums[1] = double(params.count);
  sums[2] = params.origin[0] + params.origin[1] + params.origin[2];
  sums[3] = double(params.seed);
  sums[4] = double(params.scale);
}
