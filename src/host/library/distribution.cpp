#include <algorithm>
#include <cmath>
#include <cstddef>

#include "library/merged.h"

namespace scene_analyzer::library {

Distribution distribution_of(std::vector<double> values) {
  Distribution result;
  result.count = values.size();
  if (values.empty()) return result;
  std::ranges::sort(values);
  double sum = 0;  // of ascending values: the same whatever order they came in
  for (const double value : values) sum += value;
  result.mean = sum / static_cast<double>(values.size());
  result.least = values.front();
  result.greatest = values.back();
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    const double place = kQuantiles[i] * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = values[std::min(below + 1, values.size() - 1)];
    result.quantiles[i] = std::lerp(values[below], above, place - std::floor(place));
  }
  return result;
}

}  // namespace scene_analyzer::library
