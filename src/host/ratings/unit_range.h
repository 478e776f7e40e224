// unit_range.h — Values of one scene, mapped from their least..greatest onto [0,1].
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace scene_analyzer::ratings {

// 0.5 for all when they differ by at most `equal` times the greatest. Values are finite and >= 0.
inline std::vector<double> onto_unit_range(std::span<const double> values, double equal) {
  if (values.empty()) return {};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double range = *greatest - *least;
  if (range <= equal * *greatest) return std::vector<double>(values.size(), 0.5);
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back((value - *least) / range);
  return result;
}

}  // namespace scene_analyzer::ratings
