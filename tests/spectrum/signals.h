// signals.h — Signals to transform, FFTW as the oracle, and the comparison with it.
#pragma once

#include <fftw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/spectrum.h"
#include "spectrum/spectrum.h"
#include "support/gpu_test.h"
#include "support/meshes.h"

namespace scene_analyzer::spectrum {

using Samples = std::vector<double>;

// Positive and of all sizes, as areas are.
inline Samples random_samples(std::uint64_t size, std::uint64_t seed) {
  test_meshes::Random random(seed);
  Samples samples(size);
  for (double& sample : samples) sample = std::exp2(random.between(-8, 2));
  return samples;
}

inline std::vector<std::span<const double>> spans_of(const std::vector<Samples>& signals) {
  return {signals.begin(), signals.end()};
}

inline reference::Spectrum fftw_spectrum(const Samples& samples) {
  Samples input = samples;
  std::vector<std::complex<double>> output(samples.size() / 2 + 1);
  fftw_plan plan = fftw_plan_dft_r2c_1d(static_cast<int>(input.size()), input.data(),
                                        reinterpret_cast<fftw_complex*>(output.data()), FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  std::vector<double> magnitudes;
  for (const auto& value : output) magnitudes.push_back(std::abs(value));
  return reference::totals_of(std::move(magnitudes));
}

struct Found {
  std::vector<SpectrumTotals> totals;
  std::vector<std::vector<double>> magnitudes;
};

inline Found transformed(SpectrumBuilder& builder, const std::vector<Samples>& signals) {
  Found found;
  found.magnitudes.resize(signals.size());
  found.totals = builder.transform(spans_of(signals), [&](std::size_t i, std::span<const double> magnitudes) {
    EXPECT_TRUE(found.magnitudes.at(i).empty());
    found.magnitudes[i].assign(magnitudes.begin(), magnitudes.end());
  });
  return found;
}

// What is asked for is 1e-9; what is found with sound tables is some 1e-14.
inline constexpr double kTolerance = 1e-12;

// Magnitudes relative to the largest, and but for FFTW's own rounding to the largest but |X_0|; totals
// relative to their size, where they are more than rounding.
inline void expect_spectrum(const SpectrumTotals& totals, const std::vector<double>& magnitudes,
                            const reference::Spectrum& expected) {
  ASSERT_EQ(magnitudes.size(), expected.magnitudes.size());
  const double largest = magnitudes.empty() ? 0 : std::ranges::max(expected.magnitudes);
  double worst = 0;
  for (std::size_t k = 0; k < magnitudes.size(); ++k)
    worst = std::max(worst, std::abs(magnitudes[k] - expected.magnitudes[k]));
  EXPECT_LE(worst, kTolerance * expected.largest + 1e-15 * largest);
  const double rounding = 1e-13 * largest * static_cast<double>(magnitudes.size());
  EXPECT_NEAR(totals.zero, expected.zero, kTolerance * expected.zero + 1e-13 * largest);
  EXPECT_NEAR(totals.largest, expected.largest, kTolerance * expected.largest + 1e-13 * largest);
  EXPECT_NEAR(totals.sum, expected.sum, kTolerance * expected.sum + rounding);
  EXPECT_NEAR(totals.weighted_sum, expected.weighted_sum,
              kTolerance * expected.weighted_sum + rounding * static_cast<double>(magnitudes.size()));
}

inline bool operator==(const SpectrumTotals& a, const SpectrumTotals& b) {
  return a.zero == b.zero && a.largest == b.largest && a.sum == b.sum && a.weighted_sum == b.weighted_sum;
}

}  // namespace scene_analyzer::spectrum
