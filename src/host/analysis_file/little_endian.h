// little_endian.h — Integers and doubles as little-endian bytes, on any machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scene_analyzer::analysis_file {

template <std::unsigned_integral T>
void append(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFF);
}

inline void append(std::string& bytes, double value) {
  append(bytes, std::bit_cast<std::uint64_t>(value));
}

// The caller has made sure that bytes [offset, offset + sizeof(T)) exist.
template <std::unsigned_integral T>
T read_at(std::string_view bytes, std::size_t offset) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i));
  return value;
}

}  // namespace scene_analyzer::analysis_file
