// byte_text.h — Sizes as people write them: "500M", "2G", "1.5G", "4096"; K, M, G, T are powers of 1024.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace scene_analyzer {

inline constexpr std::string_view kByteExamples = "a size such as 4096, 500M or 2G";

// Bytes, at most 2^60; nothing where the whole text is no such size.
inline std::optional<std::uint64_t> bytes_of(std::string_view text) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr double kGreatest = 0x1p60;  // also keeps the conversion below defined
  double factor = 1;
  if (!text.empty() && kUnits.find(text.back()) != std::string_view::npos) {
    factor = std::exp2(10.0 * static_cast<double>(kUnits.find(text.back()) + 1));
    text.remove_suffix(1);
  }
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!(value >= 0 && value * factor <= kGreatest)) return std::nullopt;
  return static_cast<std::uint64_t>(value * factor);
}

}  // namespace scene_analyzer
