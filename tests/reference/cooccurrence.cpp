#include "reference/cooccurrence.h"

#include <algorithm>

namespace scene_analyzer::reference {
namespace {

constexpr double kUniform = 1e-5;  // relative to the largest value

bool uniform(const AreaClasses& classes) {
  return classes.value.empty() ||
         classes.value.back() - classes.value.front() <= kUniform * classes.value.back();
}

// The sum over j on the edge of (A_i - A_j)^2 is k (A_i - mean)^2 + the sum of (A_j - mean)^2.
long double edge_contrast(std::span<const std::uint32_t> edge, const Adjacency& adjacency,
                          const AreaClasses& classes) {
  const auto value = [&](std::uint32_t half_edge) -> long double {
    return classes.value[classes.class_of[half_edge / 3]];
  };
  const auto count = static_cast<long double>(edge.size());
  long double mean = 0;
  for (const std::uint32_t half_edge : edge) mean += value(half_edge) / count;
  long double spread = 0;
  for (const std::uint32_t half_edge : edge) spread += (value(half_edge) - mean) * (value(half_edge) - mean);
  long double sum = 0;
  for (const std::uint32_t half_edge : edge) {
    const long double deviation = value(half_edge) - mean;
    sum += (count * deviation * deviation + spread) / adjacency.neighbours[half_edge / 3];
  }
  return sum;
}

using Histogram = std::vector<std::pair<std::uint32_t, std::uint64_t>>;

// How often each class of `class_of` occurs on the edge, classes ascending.
Histogram occurrences(std::span<const std::uint32_t> edge, std::span<const std::uint32_t> class_of) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t half_edge : edge) found.push_back(class_of[half_edge / 3]);
  std::sort(found.begin(), found.end());
  Histogram result;
  for (const std::uint32_t c : found) {
    if (result.empty() || result.back().first != c) result.emplace_back(c, 0);
    ++result.back().second;
  }
  return result;
}

// Calls count(row, column, ordered pairs) for what each edge adds.
template <typename Count>
void for_each_class_pair(const Adjacency& adjacency, std::span<const std::uint32_t> class_of, Count count) {
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e) {
    if (adjacency.edge(e).size() < 2) continue;
    const Histogram histogram = occurrences(adjacency.edge(e), class_of);
    for (const auto& [row, row_count] : histogram)
      for (const auto& [column, column_count] : histogram) {
        const std::uint64_t pairs = row == column ? row_count * (row_count - 1) : row_count * column_count;
        if (pairs > 0) count(row, column, pairs);
      }
  }
}

}  // namespace

Contrast cooccurrence_contrast(const Adjacency& adjacency, const AreaClasses& classes) {
  Contrast result;
  for (const std::uint32_t neighbours : adjacency.neighbours)
    if (neighbours > 0) ++result.neighboured;
  if (result.neighboured == 0 || uniform(classes)) return result;
  long double sum = 0;
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e)
    if (adjacency.edge(e).size() > 1) sum += edge_contrast(adjacency.edge(e), adjacency, classes);
  const long double range = static_cast<long double>(classes.value.back()) - classes.value.front();
  result.rating = static_cast<double>(sum / (static_cast<long double>(result.neighboured) * range * range));
  return result;
}

ClassPairs count_class_pairs(const Adjacency& adjacency, const AreaClasses& classes) {
  ClassPairs result;
  for_each_class_pair(adjacency, classes.class_of,
                      [&](std::uint32_t row, std::uint32_t column, std::uint64_t pairs) {
                        result[{row, column}] += pairs;
                      });
  return result;
}

BinnedPairs count_binned_pairs(const Adjacency& adjacency, const AreaClasses& classes) {
  std::vector<std::uint32_t> bin_of(classes.class_of.size());
  if (!uniform(classes)) {
    const double least = classes.value.front();
    const double range = classes.value.back() - least;
    for (std::size_t triangle = 0; triangle < bin_of.size(); ++triangle) {
      if (classes.class_of[triangle] == kNone) continue;
      const double value = classes.value[classes.class_of[triangle]];
      bin_of[triangle] = std::min(static_cast<std::uint32_t>(kBins * (value - least) / range), kBins - 1);
    }
  }
  BinnedPairs result{};
  for_each_class_pair(adjacency, bin_of, [&](std::uint32_t row, std::uint32_t column, std::uint64_t pairs) {
    result[std::size_t{row} * kBins + column] += pairs;
  });
  return result;
}

}  // namespace scene_analyzer::reference
