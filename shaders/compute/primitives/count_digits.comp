// count_digits.comp — One workgroup per tile of keys: how often each digit occurs, counts[digit * tiles + tile].
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/primitives.h"
layout(local_size_x = 32) in;
layout(push_constant, scalar) uniform Block { SortParams params; };
layout(binding = 0, scalar) readonly buffer Words { uint words[]; };  // the half of the key that holds the digit
layout(binding = 1, scalar) writeonly buffer Counts { uint counts[]; };
#include "compute/lib/threads.glsl"
#include "compute/primitives/digit_counters.glsl"

void main() {
  uint tile = global_group();
  uint first = tile * kTileKeys + gl_LocalInvocationID.x * kKeysPerThread;
  uint last = min(first + kKeysPerThread, params.count);
  clear_counters();
  for (uint i = first; i < last; ++i) count_digit((words[i] >> (params.shift & 31u)) & 0xFFu);
  barrier();
  if (tile >= params.tiles) return;
  for (uint word = gl_LocalInvocationID.x; word < kWords; word += kSortThreads) {
    uint sum = 0;
    for (uint thread = 0; thread < kSortThreads; ++thread) sum += counters[word * kSortThreads + thread];
    counts[(2 * word) * params.tiles + tile] = sum & 0xFFFFu;
    counts[(2 * word + 1) * params.tiles + tile] = sum >> 16;
  }
}
