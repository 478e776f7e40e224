// scatter_digits.comp — One workgroup per tile: moves keys and values to their places by one digit, stably.
//
// offsets[digit * tiles + tile]: where the tile's keys with that digit begin (exclusive scan of count_digits.comp's counts).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/primitives.h"
layout(local_size_x = 32) in;
layout(push_constant, scalar) uniform Block { SortParams params; };
layout(binding = 0, scalar) readonly buffer Offsets { uint offsets[]; };
layout(binding = 1, scalar) readonly buffer LowIn { uint low_in[]; };
layout(binding = 2, scalar) readonly buffer HighIn { uint high_in[]; };
layout(binding = 3, scalar) readonly buffer ValuesIn { uint values_in[]; };
layout(binding = 4, scalar) writeonly buffer LowOut { uint low_out[]; };
layout(binding = 5, scalar) writeonly buffer HighOut { uint high_out[]; };
layout(binding = 6, scalar) writeonly buffer ValuesOut { uint values_out[]; };
layout(binding = 7, scalar) readonly buffer Words { uint words[]; };  // the half of the key that holds the digit
#include "compute/lib/threads.glsl"
#include "compute/primitives/digit_counters.glsl"

shared uint tile_offsets[kDigits];

// Counters become, for each digit, the number of keys in the threads before.
void scan_counters() {
  for (uint word = gl_LocalInvocationID.x; word < kWords; word += kSortThreads) {
    uint running = 0;
    for (uint thread = 0; thread < kSortThreads; ++thread) {
      uint own = counters[word * kSortThreads + thread];
      counters[word * kSortThreads + thread] = running;
      running += own;
    }
  }
}

void main() {
  uint tile = global_group();
  uint first = tile * kTileKeys + gl_LocalInvocationID.x * kKeysPerThread;
  uint last = tile < params.tiles ? min(first + kKeysPerThread, params.count) : first;
  for (uint digit = gl_LocalInvocationID.x; digit < kDigits; digit += kSortThreads)
    tile_offsets[digit] = tile < params.tiles ? offsets[digit * params.tiles + tile] : 0;
  clear_counters();
  for (uint i = first; i < last; ++i) count_digit((words[i] >> (params.shift & 31u)) & 0xFFu);
  barrier();
  scan_counters();
  barrier();
  for (uint i = first; i < last; ++i) {
    uint digit = (words[i] >> (params.shift & 31u)) & 0xFFu;
    uint place = tile_offsets[digit] + count_digit(digit);
    low_out[place] = low_in[i];
    high_out[place] = high_in[i];
    values_out[place] = values_in[i];
  }
}
