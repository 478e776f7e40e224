// The transform's twin: values from paper, and what every transform obeys.
#include "reference/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/meshes.h"

namespace scene_analyzer {
namespace {

using reference::spectrum;

TEST(ReferenceSpectrum, ValuesFromPaper) {
  // A constant and an impulse: the constant is X_0's alone, the impulse is in all frequencies.
  const reference::Spectrum impulse = spectrum(std::vector<double>{1000, 100, 100, 100});
  EXPECT_NEAR(impulse.magnitudes[0], 1300, 1e-9);
  EXPECT_NEAR(impulse.magnitudes[1], 900, 1e-9);
  EXPECT_NEAR(impulse.magnitudes[2], 900, 1e-9);
  EXPECT_NEAR(impulse.weighted_sum, 900 + 2 * 900, 1e-9);
  // Alternating values: the highest frequency's.
  const reference::Spectrum alternating = spectrum(std::vector<double>{3, 1, 3, 1, 3, 1});
  EXPECT_THAT(alternating.magnitudes, testing::Pointwise(testing::DoubleNear(1e-12), {12.0, 0.0, 0.0, 6.0}));
  EXPECT_NEAR(alternating.largest, 6, 1e-12);
  EXPECT_NEAR(alternating.sum, 6, 1e-12);
}

TEST(ReferenceSpectrum, OfNothingAndOfOneSample) {
  EXPECT_TRUE(spectrum({}).magnitudes.empty());
  const reference::Spectrum single = spectrum(std::vector<double>{-7});
  EXPECT_EQ(single.zero, 7);
  EXPECT_EQ(single.largest, 0);
  EXPECT_EQ(single.sum, 0);
}

TEST(ReferenceSpectrum, EnergyIsThatOfTheSamplesAndRotationDoesNotShow) {
  test_meshes::Random random(1);
  for (const std::size_t size : {2U, 7U, 12U, 31U, 64U}) {
    std::vector<double> samples(size);
    double energy = 0;
    for (double& sample : samples) {
      sample = random.between(-1, 2);
      energy += sample * sample;
    }
    const std::vector<double> magnitudes = spectrum(samples).magnitudes;
    double found = 0;  // all frequencies but 0 and size / 2 occur twice
    for (std::size_t k = 0; k < magnitudes.size(); ++k)
      found += magnitudes[k] * magnitudes[k] * (k == 0 || 2 * k == size ? 1 : 2);
    EXPECT_NEAR(found / static_cast<double>(size), energy, 1e-12);
    std::ranges::rotate(samples, samples.begin() + 1);
    EXPECT_THAT(spectrum(samples).magnitudes, testing::Pointwise(testing::DoubleNear(1e-12), magnitudes));
  }
}

}  // namespace
}  // namespace scene_analyzer
