// mark_key_starts.comp — One thread per sorted key, and one more: 1 where a run of equal keys starts, 0 elsewhere and at the end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedKeysParams params; };
layout(binding = 0, scalar) readonly buffer Low { uint low[]; };
layout(binding = 1, scalar) readonly buffer High { uint high[]; };
layout(binding = 2, scalar) writeonly buffer Starts { uint starts[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place > params.count) return;
  bool starts_here = place == 0;
  if (place > 0 && place < params.count) starts_here = low[place] != low[place - 1] || high[place] != high[place - 1];
  starts[place] = starts_here && place < params.count ? 1 : 0;
}
