#include "import/obj_check.h"

#include <algorithm>

namespace scene_analyzer::import {
namespace {

constexpr std::string_view kSpace = " \t\r";

// Up to three words at the start of `text`; the rest does not matter.
int count_words(std::string_view text, int most) {
  int count = 0;
  while (count < most) {
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos || text[first] == '#' || text[first] == '\\') return count;
    ++count;
    text.remove_prefix(std::min(text.size(), text.find_first_of(kSpace, first)));
  }
  return count;
}

bool goes_on(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line.ends_with('\\');
}

// The line at the start of `contents`, which moves behind it.
std::string_view take_line(std::string_view& contents) {
  const std::size_t end = contents.find('\n');
  const std::string_view line = contents.substr(0, end);
  contents.remove_prefix(end == std::string_view::npos ? contents.size() : end + 1);
  return line;
}

bool is_indented(std::string_view line) {
  return !line.empty() && (line.front() == ' ' || line.front() == '\t') &&
         line.find_first_not_of(kSpace) != std::string_view::npos;
}

// Calls `take(line, first_of_statement)` for every line, its end included.
template <typename Take>
void for_each_line(std::string_view contents, const Take& take) {
  bool continued = false;
  while (!contents.empty()) {
    const char* const begin = contents.data();
    const std::string_view line = take_line(contents);
    take(std::string_view(begin, static_cast<std::size_t>(contents.data() - begin)), !continued);
    continued = goes_on(line);
  }
}

}  // namespace

std::string without_indentation(std::string_view contents) {
  bool indented = false;
  for_each_line(contents, [&](std::string_view line, bool first) { indented |= first && is_indented(line); });
  std::string text;
  if (!indented) return text;
  text.reserve(contents.size());
  for_each_line(contents, [&](std::string_view line, bool first) {
    text += first && is_indented(line) ? line.substr(line.find_first_not_of(kSpace)) : line;
  });
  return text;
}

std::uint64_t count_obj_faces(std::string_view contents) {
  constexpr int kLeastCorners = 3;
  std::uint64_t faces = 0;
  while (!contents.empty()) {
    std::string_view line = take_line(contents);
    const std::size_t first = std::min(line.size(), line.find_first_not_of(kSpace));
    const bool is_face = line.size() > first + 1 && line[first] == 'f' &&
                         kSpace.find(line[first + 1]) != std::string_view::npos;
    int corners = is_face ? count_words(line.substr(first + 1), kLeastCorners) : 0;
    while (goes_on(line) && !contents.empty()) {
      line = take_line(contents);
      if (is_face) corners += count_words(line, kLeastCorners);
    }
    faces += corners >= kLeastCorners ? 1 : 0;
  }
  return faces;
}

}  // namespace scene_analyzer::import
