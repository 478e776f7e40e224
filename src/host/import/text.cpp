#include "import/text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace scene_analyzer::import {
namespace {

struct Character {
  std::uint32_t code = 0xFFFD;
  std::size_t bytes = 1;
  bool valid = false;
};

// One character from the start of `text`; an invalid sequence is one invalid character of one byte.
Character decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kSmallest[bytes] || code > 0x10FFFF || surrogate) return {};
  return {code, bytes, true};
}

// Controls, line separators and bidirectional marks: they break tables, terminals and logs.
bool is_harmful(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t longest) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  constexpr std::string_view kEllipsis = "...";
  std::string clean;
  clean.reserve(std::min(text.size(), longest));
  std::size_t fits_with_ellipsis = 0;
  while (!text.empty()) {
    const Character character = decode(text);
    const std::string_view written = character.valid ? text.substr(0, character.bytes) : kReplacement;
    text.remove_prefix(character.bytes);
    if (character.valid && is_harmful(character.code)) continue;
    if (clean.size() + written.size() > longest) {
      clean.resize(fits_with_ellipsis);
      return clean += kEllipsis;
    }
    clean += written;
    if (clean.size() + kEllipsis.size() <= longest) fits_with_ellipsis = clean.size();
  }
  return clean;
}

}  // namespace scene_analyzer::import
