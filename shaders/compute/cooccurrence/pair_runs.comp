// pair_runs.comp — One thread per pair of runs of the window: its labels, and how many pairs of triangles it stands for.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { PairParams params; };
layout(binding = 0, scalar) readonly buffer RunLow { uint low[]; };
layout(binding = 1, scalar) readonly buffer RunHigh { uint high[]; };
layout(binding = 2, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 3, scalar) readonly buffer Firsts { uint firsts[]; };
layout(binding = 4, scalar) readonly buffer Ends { uint ends[]; };
layout(binding = 5, scalar) readonly buffer Offsets { uint offsets[]; };
layout(binding = 6, scalar) writeonly buffer PairLow { uint pair_low[]; };
layout(binding = 7, scalar) writeonly buffer PairHigh { uint pair_high[]; };
layout(binding = 8, scalar) writeonly buffer Values { uint values[]; };
layout(binding = 9, scalar) writeonly buffer Weights { uint64_t weights[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/label_runs.glsl"

// The last run whose pairs begin at or before this one: runs without pairs begin where the next one does.
uint run_of_pair(uint pair) {
  uint low_run = 0, high_run = params.runs;
  while (high_run - low_run > 1) {
    uint middle = (low_run + high_run) / 2;
    if (offsets[middle] <= pair) low_run = middle; else high_run = middle;
  }
  return low_run;
}

void main() {
  uint index = global_thread();
  if (index >= params.count) return;
  uint pair = params.first + index;
  uint own = run_of_pair(pair);
  uint other = edge_of_run(own).first_run + (pair - offsets[own]);
  uint64_t key = (uint64_t(label_of_run(own)) << params.label_bits) | uint64_t(label_of_run(other));
  pair_low[index] = uint(key & 0xFFFFFFFFul);
  pair_high[index] = uint(key >> 32);
  values[index] = index;
  weights[index] = pairs_of_runs(own, other);
}
