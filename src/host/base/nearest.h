// nearest.h — What was probably meant by a word that is unknown.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scene_analyzer {

// The candidate with the least edit distance to `text`, or "" when none is near enough to be meant. Cost: the
// product of the lengths, for each candidate.
inline std::string nearest(std::string_view text, std::span<const std::string> candidates) {
  std::string best;
  // Two letters swapped or a third of a long word may be wrong; beyond that a suggestion misleads.
  const std::size_t allowed = text.size() < 4 ? 1 : std::max<std::size_t>(2, text.size() / 3);
  std::size_t best_distance = allowed + 1;
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);  // Levenshtein, one row at a time
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= text.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j < row.size(); ++j) {
        const std::size_t substituted = diagonal + (text[i - 1] == candidate[j - 1] ? 0 : 1);
        diagonal = row[j];
        row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

}  // namespace scene_analyzer
