// density.cpp — Relative density: how far a mesh's triangles per area lie from the scene's mean.
#include <algorithm>
#include <cmath>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

// Densities as small as 1e-70 and as large as 1e+70 occur in real files (units, float32 coordinates), and
// their squares must not overflow or vanish. Scaling by a power of two is exact, so ordinary scenes keep
// every bit.
struct Scaled {
  std::vector<double> values;  // the largest in [0.5, 1)
  int exponent = 0;
};

Scaled scaled(std::span<const double> densities) {
  Scaled result;
  std::frexp(*std::max_element(densities.begin(), densities.end()), &result.exponent);
  result.values.reserve(densities.size());
  for (const double density : densities) result.values.push_back(std::ldexp(density, -result.exponent));
  return result;
}

DensityStatistics statistics_of(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  DensityStatistics result;
  result.mean = sum / count;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / count);
  return result;
}

}  // namespace

DensityStatistics density_statistics(std::span<const double> densities) {
  if (densities.empty()) return {};
  const Scaled scene = scaled(densities);
  const DensityStatistics statistics = statistics_of(scene.values);
  return {std::ldexp(statistics.mean, scene.exponent), std::ldexp(statistics.deviation, scene.exponent)};
}

std::vector<double> relative_densities(std::span<const double> densities) {
  if (densities.empty()) return {};
  const std::vector<double> values = scaled(densities).values;
  const auto [mean, deviation] = statistics_of(values);
  const double noise = 1e-6 * mean;
  if (deviation <= noise) return std::vector<double>(values.size(), 0.0);

  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double low = mean - deviation;
  const double high = mean + deviation;
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) {
    // The outer branches are entered only beyond the noise, so their divisors are never near 0.
    if (value < low - noise)
      result.push_back(-0.5 - 0.5 * ((value - low) / (*least - low)));
    else if (value > high + noise)
      result.push_back(0.5 + 0.5 * ((value - high) / (*greatest - high)));
    else
      result.push_back(std::clamp(-0.5 + (value - low) / (2 * deviation), -0.5, 0.5));
  }
  return result;
}

}  // namespace scene_analyzer::ratings
