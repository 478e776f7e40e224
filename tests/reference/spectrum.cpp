#include "reference/spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace scene_analyzer::reference {

Spectrum totals_of(std::vector<double> magnitudes) {
  Spectrum result;
  long double sum = 0, weighted_sum = 0;
  for (std::size_t k = 1; k < magnitudes.size(); ++k) {
    result.largest = std::max(result.largest, magnitudes[k]);
    sum += magnitudes[k];
    weighted_sum += static_cast<long double>(k) * magnitudes[k];
  }
  if (!magnitudes.empty()) result.zero = magnitudes.front();
  result.sum = static_cast<double>(sum);
  result.weighted_sum = static_cast<double>(weighted_sum);
  result.magnitudes = std::move(magnitudes);
  return result;
}

Spectrum spectrum(std::span<const double> samples) {
  const std::size_t size = samples.size();
  if (size == 0) return {};
  std::vector<long double> cosines, sines;
  for (std::size_t j = 0; j < size; ++j) {
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(j) / size;
    cosines.push_back(std::cos(angle));
    sines.push_back(std::sin(angle));
  }
  std::vector<double> magnitudes;
  for (std::size_t k = 0; k <= size / 2; ++k) {
    long double real = 0, imaginary = 0;
    for (std::size_t n = 0; n < size; ++n) {
      real += samples[n] * cosines[k * n % size];
      imaginary -= samples[n] * sines[k * n % size];
    }
    magnitudes.push_back(static_cast<double>(std::hypot(real, imaginary)));
  }
  return totals_of(std::move(magnitudes));
}

}  // namespace scene_analyzer::reference
