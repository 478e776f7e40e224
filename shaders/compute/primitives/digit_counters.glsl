// digit_counters.glsl — How often each digit occurs in each thread's keys of a tile, in shared memory.
//
// Every thread owns a column of kDigits 16-bit counters, two digits to a word, so that nothing is atomic and equal keys keep
// their order (thread 0's keys come first).
#ifndef SCENE_ANALYZER_DIGIT_COUNTERS
#define SCENE_ANALYZER_DIGIT_COUNTERS

const uint kWords = kDigits / 2;
shared uint counters[kWords * kSortThreads];

uint counter_word(uint digit, uint thread) { return (digit >> 1) * kSortThreads + thread; }
uint counter_shift(uint digit) { return (digit & 1u) * 16u; }

void clear_counters() {
  for (uint word = 0; word < kWords; ++word) counters[word * kSortThreads + gl_LocalInvocationID.x] = 0;
}

// Returns how many of the thread's keys had this digit before, plus what the counter started from.
uint count_digit(uint digit) {
  uint word = counter_word(digit, gl_LocalInvocationID.x);
  uint before = counters[word];
  counters[word] = before + (1u << counter_shift(digit));
  return (before >> counter_shift(digit)) & 0xFFFFu;
}

#endif
