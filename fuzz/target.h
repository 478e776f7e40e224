// target.h — What a fuzz target is: one function that takes any bytes, and valid inputs to start from.
//
// The same object file is linked twice: with libFuzzer (preset `fuzz`, script/fuzz), and with replay.cpp,
// which the test suite runs over seeds, regressions and seeded mutations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace scene_analyzer::fuzz {

// Made by the builders of the tests; the same in every run.
std::vector<std::string> seeds();

// A promise that does not hold ends the program, which is how libFuzzer knows what to keep.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace scene_analyzer::fuzz
