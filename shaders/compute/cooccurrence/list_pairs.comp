// list_pairs.comp — One thread per sorted pair of labels: the distinct pairs, and the sum of what equal ones stand for.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedKeysParams params; };
layout(binding = 0, scalar) readonly buffer Low { uint low[]; };
layout(binding = 1, scalar) readonly buffer High { uint high[]; };
layout(binding = 2, scalar) readonly buffer Values { uint values[]; };
layout(binding = 3, scalar) readonly buffer Weights { uint64_t weights[]; };
layout(binding = 4, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 5, scalar) writeonly buffer PairLow { uint pair_low[]; };
layout(binding = 6, scalar) writeonly buffer PairHigh { uint pair_high[]; };
layout(binding = 7, scalar) buffer Counters { uint counters[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/wide_counters.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint pair = starts[place + 1] - 1;
  if (starts[place] == pair) {
    pair_low[pair] = low[place];
    pair_high[pair] = high[place];
  }
  add_wide(pair, weights[values[place]]);
}
