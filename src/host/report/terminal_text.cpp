#include "report/terminal_text.h"

#include <wchar.h>

#include <algorithm>
#include <cstdint>

namespace scene_analyzer::report {
namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr char32_t kEllipsis = 0x2026;

// Length of a sequence by its first byte, 0 for bytes that start none.
std::size_t sequence_length(std::uint8_t lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

// The character at the start of `text`, and its bytes; kReplacement and one byte where it is malformed.
struct Decoded {
  char32_t character = kReplacement;
  std::size_t bytes = 1;
};

Decoded decode_one(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::size_t length = sequence_length(byte(0));
  if (length == 0 || length > text.size()) return {};
  if (length == 1) return {byte(0), 1};
  char32_t value = byte(0) & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3Fu);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xD800 && value < 0xE000;
  if (value < kLeast[length] || value > 0x10FFFF || surrogate) return {};
  return {value, length};
}

// Invisible characters that reorder, break or hide the rest of a line.
bool steers_layout(char32_t c) {
  return c == 0x061C || (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || (c >= 0xFFF9 && c <= 0xFFFB) ||
         (c >= 0xE0000 && c <= 0xE0FFF);
}

// Columns, or -1 for what must not be printed. The two characters put in here do not depend on the locale.
int width_of(char32_t c) {
  if (c == kReplacement || c == kEllipsis) return 1;
  return c == 0 ? -1 : ::wcwidth(static_cast<wchar_t>(c));
}

std::size_t width_of_printable(char32_t c) {
  return static_cast<std::size_t>(std::max(width_of(c), 0));
}

}  // namespace

std::u32string decode_utf8(std::string_view text) {
  std::u32string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Decoded decoded = decode_one(text);
    result.push_back(decoded.character);
    text.remove_prefix(decoded.bytes);
  }
  return result;
}

std::string encode_utf8(std::u32string_view text) {
  std::string result;
  result.reserve(text.size());
  const auto push = [&](char32_t bits) { result.push_back(static_cast<char>(bits)); };
  for (const char32_t c : text) {
    if (c < 0x80) {
      push(c);
    } else if (c < 0x800) {
      push(0xC0 | c >> 6), push(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
      push(0xE0 | c >> 12), push(0x80 | (c >> 6 & 0x3F)), push(0x80 | (c & 0x3F));
    } else {
      push(0xF0 | c >> 18), push(0x80 | (c >> 12 & 0x3F)), push(0x80 | (c >> 6 & 0x3F)),
          push(0x80 | (c & 0x3F));
    }
  }
  return result;
}

// Without the locale (it is part of the C library's own package) names lose their non-ASCII letters, but
// nothing breaks.
UnicodeScope::UnicodeScope()
    : unicode_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)),
      before_(unicode_ ? ::uselocale(unicode_) : nullptr) {}

UnicodeScope::~UnicodeScope() {
  if (!unicode_) return;
  ::uselocale(before_);
  ::freelocale(unicode_);
}

std::u32string printable(std::string_view text) {
  std::u32string result = decode_utf8(text);
  for (char32_t& c : result)
    if (width_of(c) < 0 || steers_layout(c)) c = kReplacement;
  return result;
}

std::size_t columns(std::u32string_view printable_text) {
  std::size_t sum = 0;
  for (const char32_t c : printable_text) sum += width_of_printable(c);
  return sum;
}

std::u32string shortened(std::u32string_view printable_text, std::size_t width) {
  if (columns(printable_text) <= width) return std::u32string(printable_text);
  // The text is wider than both parts together, so neither loop runs off its end.
  const std::size_t head_width = width / 2;
  const std::size_t tail_width =
      width - 1 - std::min(head_width, width - 1);  // the ellipsis takes one column
  std::size_t head = 0;
  for (std::size_t used = 0;
       (used += width_of_printable(printable_text[head])) <= std::min(head_width, width - 1);)
    ++head;
  std::size_t tail = printable_text.size();
  for (std::size_t used = 0; (used += width_of_printable(printable_text[tail - 1])) <= tail_width;) --tail;
  // A combining mark must not land on the ellipsis.
  while (tail < printable_text.size() && width_of_printable(printable_text[tail]) == 0) ++tail;
  return std::u32string(printable_text.substr(0, head)) + kEllipsis +
         std::u32string(printable_text.substr(tail));
}

}  // namespace scene_analyzer::report
