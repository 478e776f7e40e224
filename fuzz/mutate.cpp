#include "mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace scene_analyzer::fuzz {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t bound) {
  return bound == 0 ? 0 : static_cast<std::size_t>(random() % bound);
}

// Where counts, offsets and lengths go wrong.
constexpr std::array<std::uint64_t, 18> kNumbers = {0,
                                                    1,
                                                    2,
                                                    3,
                                                    0x7F,
                                                    0x80,
                                                    0xFF,
                                                    0x7FFF,
                                                    0xFFFF,
                                                    0x10000,
                                                    0x7FFFFFFF,
                                                    0x80000000,
                                                    0xFFFFFFFF,
                                                    0x55555556,  // times 12 is 8 in 32 bits
                                                    0x7FC00000,  // a NaN of 32 bits
                                                    0x7FF8000000000000,
                                                    0x7FFFFFFFFFFFFFFF,
                                                    0xFFFFFFFFFFFFFFFF};
constexpr std::array<std::string_view, 20> kTexts = {"0",
                                                     "-1",
                                                     "1",
                                                     "3",
                                                     "255",
                                                     "65536",
                                                     "2147483647",
                                                     "2147483648",
                                                     "4294967295",
                                                     "4294967296",
                                                     "99999999999999999999",
                                                     "-99999999999999999999",
                                                     "1e39",
                                                     "1e999",
                                                     "-1e-400",
                                                     "nan",
                                                     "inf",
                                                     "0x10",
                                                     "",
                                                     "../../../../etc/passwd"};

void set_number(std::string& bytes, Random& random) {
  constexpr std::array<std::size_t, 4> kWidths = {1, 2, 4, 8};
  const std::size_t width = kWidths[below(random, kWidths.size())];
  if (bytes.size() < width) return;
  const std::uint64_t value = kNumbers[below(random, kNumbers.size())] + below(random, 3) - 1;
  const std::size_t at = below(random, bytes.size() - width + 1);
  const bool big_endian = random() % 4 == 0;
  for (std::size_t i = 0; i < width; ++i)
    bytes[at + (big_endian ? width - 1 - i : i)] = static_cast<char>(value >> 8 * i & 0xFF);
}

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' || c == '_';
}

// [begin, end) of words, or of those that look like numbers, in at most 64 KiB from a random place.
std::vector<std::pair<std::size_t, std::size_t>> words(const std::string& bytes, bool numbers,
                                                       Random& random) {
  constexpr std::size_t kWindow = 65536;
  const std::size_t first = bytes.size() > kWindow ? below(random, bytes.size() - kWindow) : 0;
  const std::size_t last = std::min(bytes.size(), first + kWindow);
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = first; i < last; ++i) {
    if (!is_of_word(bytes[i])) continue;
    const std::size_t begin = i;
    while (i < last && is_of_word(bytes[i])) ++i;
    const char c = bytes[begin];
    if (!numbers || std::isdigit(static_cast<unsigned char>(c)) || c == '-') found.emplace_back(begin, i);
  }
  return found;
}

void set_text_number(std::string& bytes, Random& random) {
  const auto numbers = words(bytes, true, random);
  if (numbers.empty()) return;
  const auto [begin, end] = numbers[below(random, numbers.size())];
  bytes.replace(begin, end - begin, kTexts[below(random, kTexts.size())]);
}

void swap_words(std::string& bytes, Random& random) {
  const auto all = words(bytes, false, random);
  if (all.size() < 2) return;
  const auto [from, from_end] = all[below(random, all.size())];
  const auto [to, to_end] = all[below(random, all.size())];
  const std::string word = bytes.substr(from, from_end - from);
  bytes.replace(to, to_end - to, word);
}

void flip_bit(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  char& byte = bytes[below(random, bytes.size())];
  byte = static_cast<char>(byte ^ (1 << random() % 8));
}

void set_byte(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  bytes[below(random, bytes.size())] = static_cast<char>(random() % 256);
}

void cut_off(std::string& bytes, Random& random) {
  bytes.resize(below(random, bytes.size() + 1));
}

void erase_piece(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const std::size_t begin = below(random, bytes.size());
  bytes.erase(begin, 1 + below(random, std::min<std::size_t>(bytes.size() - begin, 64)));
}

void repeat_piece(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const std::size_t begin = below(random, bytes.size());
  const std::string piece = bytes.substr(begin, 1 + below(random, 64));
  bytes.insert(below(random, bytes.size() + 1), piece);
}

void overwrite_piece(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const std::size_t from = below(random, bytes.size()), to = below(random, bytes.size());
  const std::string piece =
      bytes.substr(from, std::min<std::size_t>(1 + below(random, 32), bytes.size() - std::max(from, to)));
  bytes.replace(to, piece.size(), piece);
}

using Change = void (*)(std::string&, Random&);
// Listed as often as they are wanted.
constexpr std::array<Change, 13> kChanges = {
    flip_bit,        set_byte,        set_number, set_number,  set_number,   set_text_number, swap_words,
    set_text_number, set_text_number, cut_off,    erase_piece, repeat_piece, overwrite_piece};

}  // namespace

std::string mutate(const std::string& original, Random& random) {
  const std::size_t longest = std::max<std::size_t>(64, 2 * original.size());
  std::string bytes = original;
  for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes)
    kChanges[below(random, kChanges.size())](bytes, random);
  bytes.resize(std::min(bytes.size(), longest));
  return bytes;
}

}  // namespace scene_analyzer::fuzz
