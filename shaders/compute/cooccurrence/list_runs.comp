// list_runs.comp — One thread per sorted key, and one more: where each run of equal keys begins, and after the last one where it ends.
//
// starts is exclusively scanned: the number of runs that started before each place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedKeysParams params; };
layout(binding = 0, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 1, scalar) writeonly buffer Firsts { uint firsts[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place > params.count) return;
  if (place == params.count || starts[place + 1] != starts[place]) firsts[starts[place]] = place;
}
