// fourier.cpp — The rating that follows from a signal's spectrum.
#include <algorithm>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {

double fourier_transform(double zero, double largest, double sum, double weighted_sum, std::uint64_t length) {
  if (length < 2 || sum <= 1e-12 * zero) return 0;
  const std::uint64_t highest = length / 2;
  const double strength = largest / zero;
  const double mean_frequency = weighted_sum / (static_cast<double>(highest) * sum);
  // Both are in [0,1], but for the rounding of the sums.
  return std::min(1.0, strength * mean_frequency);
}

}  // namespace scene_analyzer::ratings
