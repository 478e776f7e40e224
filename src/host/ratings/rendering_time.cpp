#include <algorithm>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {

std::vector<double> rendering_time_ratings(std::span<const double> times) {
  if (times.empty()) return {};
  const auto [fastest, slowest] = std::minmax_element(times.begin(), times.end());
  const double range = *slowest - *fastest;
  if (range <= 0) return std::vector<double>(times.size(), 0.5);
  std::vector<double> result;
  result.reserve(times.size());
  for (const double time : times) result.push_back((time - *fastest) / range);
  return result;
}

}  // namespace scene_analyzer::ratings
