// seen = {local size, the two constants}: what specialisation gave.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/types.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kFactor = 5;
layout(constant_id = 2) const uint kTerm = 6;
layout(set = 0, binding = 0, scalar) writeonly buffer Seen { uint seen[]; };

void main() {
  if (gl_GlobalInvocationID.x != 0) return;
  seen[0] = gl_WorkGroupSize.x;
  seen[1] = kFactor;
  seen[2] = kTerm;
}
