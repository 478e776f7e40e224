// wide_counters.glsl — 64-bit counters out of 32-bit atomics: low word, high word. Needs buffer counters.
//
// An edge of 100000 triangles has more pairs than 32 bits hold, and not every device has 64-bit atomics. Sums do not depend on the order.
#ifndef SCENE_ANALYZER_LIB_WIDE_COUNTERS
#define SCENE_ANALYZER_LIB_WIDE_COUNTERS

void add_wide(uint index, uint64_t amount) {
  uint low_word = uint(amount & 0xFFFFFFFFul);
  uint high_word = uint(amount >> 32);
  uint before = atomicAdd(counters[2 * index], low_word);
  if (before + low_word < before) ++high_word;
  if (high_word != 0) atomicAdd(counters[2 * index + 1], high_word);
}

#endif
