// aggregate.cpp — Relative mode, and seven ratings into one.
#include <algorithm>
#include <cmath>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

using analysis::index_of;
using analysis::kMetricCount;
using analysis::Metric;
using Weights = std::array<double, kMetricCount>;

constexpr std::size_t kDensity = index_of(Metric::kRelativeDensity);

// Least and greatest value of one metric in the scene.
struct Range {
  double least = 0, greatest = 0;
  bool empty = true;

  void add(double value) {
    least = empty ? value : std::min(least, value);
    greatest = empty ? value : std::max(greatest, value);
    empty = false;
  }
  // Linear onto [low, high]; unchanged when the scene's values hardly differ.
  double map(double value, double low, double high) const {
    const double extent = greatest - least;
    if (empty || extent <= 1e-5) return value;
    return low + (high - low) * ((value - least) / extent);
  }
};

// R_d and R_rt are relative to the scene by definition.
bool is_mapped(std::size_t metric) {
  return metric != index_of(Metric::kDistance) && metric != index_of(Metric::kRenderingTime);
}

std::array<Range, kMetricCount> ranges_of(std::span<const OptionalRatings> ratings) {
  std::array<Range, kMetricCount> ranges;
  for (const OptionalRatings& row : ratings)
    for (std::size_t i = 0; i < kMetricCount; ++i)
      if (row[i]) ranges[i].add(*row[i]);
  return ranges;
}

OptionalRatings mapped(const OptionalRatings& row, const std::array<Range, kMetricCount>& ranges) {
  OptionalRatings result = row;
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (row[i] && is_mapped(i)) result[i] = ranges[i].map(*row[i], i == kDensity ? -1 : 0, 1);
  return result;
}

std::optional<double> weighted_mean(const OptionalRatings& ratings, const Weights& weights) {
  // Weights may be anything from 1e-300 to 1e+300; a power of two brings them near 1 without changing a bit
  // of the mean.
  int exponent = 0;
  std::frexp(*std::max_element(weights.begin(), weights.end()), &exponent);
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < kMetricCount; ++i) {
    if (!ratings[i]) continue;
    const double weight = std::ldexp(weights[i], -exponent);
    sum += weight * *ratings[i];
    total += weight;
  }
  if (!(total > 0)) return std::nullopt;
  return sum / total;
}

void take_magnitude(OptionalRatings& row) {
  if (row[kDensity]) row[kDensity] = std::abs(*row[kDensity]);
}

}  // namespace

bool density_stands_alone(std::span<const OptionalRatings> ratings, const Weights& weights) {
  if (!(weights[kDensity] > 0)) return false;
  bool has_density = false;
  for (const OptionalRatings& row : ratings) {
    has_density = has_density || row[kDensity].has_value();
    for (std::size_t i = 0; i < kMetricCount; ++i)
      if (i != kDensity && weights[i] > 0 && row[i]) return false;
  }
  return has_density;
}

std::optional<double> aggregate(const OptionalRatings& ratings, const Weights& weights) {
  OptionalRatings row = ratings;
  if (!density_stands_alone(std::span(&ratings, 1), weights)) take_magnitude(row);
  return weighted_mean(row, weights);
}

std::vector<OptionalRatings> relative_ratings(std::span<const OptionalRatings> ratings) {
  const std::array<Range, kMetricCount> ranges = ranges_of(ratings);
  std::vector<OptionalRatings> result;
  result.reserve(ratings.size());
  for (const OptionalRatings& row : ratings) result.push_back(mapped(row, ranges));
  return result;
}

std::vector<std::optional<double>> aggregates(std::span<const OptionalRatings> ratings,
                                              const Options& options) {
  const bool keeps_sign = density_stands_alone(ratings, options.weights);
  std::array<Range, kMetricCount> ranges = ranges_of(ratings);
  Range magnitude;
  for (const OptionalRatings& row : ratings)
    if (row[kDensity]) magnitude.add(std::abs(*row[kDensity]));

  std::vector<std::optional<double>> result;
  result.reserve(ratings.size());
  for (const OptionalRatings& unmapped : ratings) {
    OptionalRatings row = options.relative ? mapped(unmapped, ranges) : unmapped;
    if (!keeps_sign && unmapped[kDensity]) {
      const double value = std::abs(*unmapped[kDensity]);
      row[kDensity] = options.relative ? magnitude.map(value, 0, 1) : value;
    }
    result.push_back(weighted_mean(row, options.weights));
  }
  return result;
}

}  // namespace scene_analyzer::ratings
