#include "render_timing/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scene_analyzer::render_timing {
namespace {

// Of normally distributed values: deviation / median absolute deviation of many values, and the error of a
// median against that of a mean, sqrt(pi / 2).
constexpr double kDeviationOfMad = 1.4826;
constexpr double kErrorOfMedian = 1.2533;

// What that deviation is too small by when there are few values (C. Croux and P. Rousseeuw, "Time-efficient
// algorithms for two highly robust estimators of scale", 1992).
double few_values(std::size_t count) {
  constexpr double kFactors[] = {1.206, 1.200, 1.140, 1.129, 1.107};  // of 5 to 9
  const auto n = static_cast<double>(count);
  return count < 10 ? kFactors[count - 5] : n / (n - 0.8);
}

// Student's t for a two-sided 95 % interval, by the expansion around the normal quantile (Abramowitz and
// Stegun 26.7.5); within 2 % from 4 degrees of freedom on.
double student_t(double freedom) {
  constexpr double z = 1.959964;
  constexpr double z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
}

double mean_of_round(const Samples& samples, std::uint32_t round) {
  double sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t rotation = 0; rotation < samples.rotations(); ++rotation) {
    const double value = samples.at(round, rotation);
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / count;
}

std::optional<double> confidence(const Samples& samples) {
  std::vector<double> means;
  for (std::uint32_t round = 0; round < samples.rounds(); ++round)
    if (const double mean = mean_of_round(samples, round); !std::isnan(mean)) means.push_back(mean);
  if (means.size() < kLeastRounds) return std::nullopt;
  const double middle = median(means);
  const auto count = static_cast<double>(means.size());
  for (double& mean : means) mean = std::abs(mean - middle);
  const double deviation = few_values(means.size()) * kDeviationOfMad * median(means);
  return student_t(count - 1) * kErrorOfMedian * deviation / std::sqrt(count);
}

}  // namespace

double median(std::vector<double>& values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::optional<Estimate> estimate(const Samples& samples) {
  if (samples.rounds() == 0) return std::nullopt;
  Estimate result;
  result.fastest = std::numeric_limits<double>::infinity();
  for (std::uint32_t rotation = 0; rotation < samples.rotations(); ++rotation) {
    std::vector<double> values;
    for (std::uint32_t round = 0; round < samples.rounds(); ++round)
      values.push_back(samples.at(round, rotation));
    const double typical = median(values);
    if (std::isnan(typical)) return std::nullopt;
    result.mean += typical / samples.rotations();
    result.fastest = std::min(result.fastest, typical);
    result.slowest = std::max(result.slowest, typical);
  }
  result.confidence = confidence(samples);
  return result;
}

}  // namespace scene_analyzer::render_timing
