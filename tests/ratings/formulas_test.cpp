// The rules of docs/metrics.md one by one, against the figures printed there and in the thesis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Pointwise;

TEST(PolygonsPerPlanarGroup, OfThePrintedMeshes) {
  EXPECT_EQ(polygons_per_planar_group(320, 320), 0);               // geosphere
  EXPECT_DOUBLE_EQ(polygons_per_planar_group(12, 6), 6.0 / 11);    // cube
  EXPECT_DOUBLE_EQ(polygons_per_planar_group(72, 8), 64.0 / 71);   // hexagonal prism
  EXPECT_NEAR(polygons_per_planar_group(40, 12), 0.717949, 5e-7);  // furniture leg
  EXPECT_EQ(polygons_per_planar_group(32, 1), 1);                  // flat grid
  EXPECT_EQ(polygons_per_planar_group(1, 1), 0);
}

TEST(PolygonsPerPlanarGroup, IsExactForCountsBeyondFloat) {
  const std::uint64_t n = (1ull << 52) + 1;
  EXPECT_EQ(polygons_per_planar_group(n, n - 1), std::ldexp(1.0, -52));
}

TEST(PlanarGroupVariation, OfThePrintedMeshes) {
  EXPECT_EQ(planar_group_variation(4, 0), 0);  // tetrahedron, no face split
  // One face split into 3 and 27; the other three faces are singletons.
  EXPECT_DOUBLE_EQ(planar_group_variation(6, 9), 0.5);
  EXPECT_DOUBLE_EQ(planar_group_variation(30, 27 * 27), 0.9);
  // Furniture leg: two caps of 10, ten sides of 2.
  EXPECT_NEAR(planar_group_variation(40, 2 * 100 + 10 * 4), 0.387298, 5e-7);
  EXPECT_EQ(planar_group_variation(32, 32 * 32), 1);
}

// The rating of a signal, by the sum that defines the transform.
double rating_of(const std::vector<double>& signal) {
  double zero = 0, largest = 0, sum = 0, weighted_sum = 0;
  for (std::size_t k = 0; k <= signal.size() / 2; ++k) {
    std::complex<double> value = 0;
    for (std::size_t i = 0; i < signal.size(); ++i)
      value += std::polar(signal[i], -2 * std::numbers::pi * static_cast<double>(k * i % signal.size()) /
                                         static_cast<double>(signal.size()));
    const double magnitude = std::abs(value);
    if (k == 0) {
      zero = magnitude;
      continue;
    }
    largest = std::max(largest, magnitude);
    sum += magnitude;
    weighted_sum += static_cast<double>(k) * magnitude;
  }
  return fourier_transform(zero, largest, sum, weighted_sum, signal.size());
}

TEST(FourierTransform, OfThePrintedSignals) {
  EXPECT_EQ(rating_of({100, 100, 100, 100, 100, 100}), 0);
  EXPECT_NEAR(rating_of({200, 100, 100, 100, 100, 100}), 0.095238095, 5e-10);
  EXPECT_NEAR(rating_of({100, 1}), 0.98019802, 5e-9);
  EXPECT_NEAR(rating_of({1000, 100, 100, 100}), 0.519230769, 5e-10);  // the thesis: 0.5625, see metrics.md
}

TEST(FourierTransform, FromMagnitudes) {
  EXPECT_DOUBLE_EQ(fourier_transform(10, 5, 8, 12, 4), 5.0 / 10 * 12 / (2 * 8));
  EXPECT_DOUBLE_EQ(fourier_transform(10, 5, 8, 12, 5), 5.0 / 10 * 12 / (2 * 8)) << "c is rounded down";
}

TEST(FourierTransform, IsZeroWhereNothingAlternates) {
  EXPECT_EQ(fourier_transform(0, 0, 0, 0, 0), 0);
  EXPECT_EQ(fourier_transform(7, 0, 0, 0, 1), 0);
  EXPECT_EQ(fourier_transform(0, 0, 0, 0, 8), 0) << "0/0";
  EXPECT_EQ(fourier_transform(1, 1e-12, 1e-12, 1e-12, 2), 0);
  EXPECT_NEAR(fourier_transform(1, 1.1e-12, 1.1e-12, 1.1e-12, 2), 1.1e-12, 1e-24);
}

TEST(FourierTransform, StaysWithinItsRangeAndIgnoresTheUnit) {
  EXPECT_EQ(fourier_transform(1, 1 + 1e-15, 1, 1 + 1e-15, 2), 1);
  EXPECT_EQ(rating_of({1, 0}), 1) << "the strongest and quickest change there is";
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> distribution(0, 3);
  for (std::size_t length = 2; length < 60; ++length) {
    std::vector<double> signal(length);
    for (double& area : signal) area = distribution(random);
    const double rated = rating_of(signal);
    EXPECT_GE(rated, 0);
    EXPECT_LE(rated, 1);
    for (double& area : signal) area *= 1e-40;
    EXPECT_NEAR(rating_of(signal), rated, 1e-12);
  }
}

const std::vector<double> kDensities = {0.0369505, 0.0558266, 0.179589, 0.40802, 0.535204, 0.56065};

TEST(RelativeDensity, OfThePrintedDensities) {
  const DensityStatistics statistics = density_statistics(kDensities);
  EXPECT_NEAR(statistics.mean, 0.29604, 5e-7);
  EXPECT_NEAR(statistics.deviation, 0.215309, 5e-7);
  // The figures were printed from unrounded densities; six digits of input leave about 1e-5.
  const std::vector<double> printed = {-1, -0.784423, -0.270428, 0.260045, 0.741934, 1};
  EXPECT_THAT(relative_densities(kDensities), Pointwise(DoubleNear(2e-5), printed));
}

TEST(RelativeDensity, FollowsTheOrderOfItsInput) {
  std::vector<double> reversed(kDensities.rbegin(), kDensities.rend());
  std::vector<double> expected = relative_densities(kDensities);
  std::reverse(expected.begin(), expected.end());
  EXPECT_THAT(relative_densities(reversed), Pointwise(DoubleNear(1e-12), expected));
}

TEST(RelativeDensity, IsZeroWhereNothingDiffers) {
  EXPECT_TRUE(relative_densities({}).empty());
  EXPECT_THAT(relative_densities(std::vector<double>{7}), ElementsAre(0.0));
  EXPECT_THAT(relative_densities(std::vector<double>(1000, 0.1)), Each(0.0));
  // A deviation of 0.9e-6 of the mean is noise, one of 1.1e-6 is not.
  EXPECT_THAT(relative_densities(std::vector<double>{1 - 0.9e-6, 1 + 0.9e-6}), Each(0.0));
  EXPECT_THAT(relative_densities(std::vector<double>{1 - 1.1e-6, 1 + 1.1e-6}),
              Pointwise(DoubleNear(1e-6), {-0.5, 0.5}));
}

TEST(RelativeDensity, OfTwoMeshesIsHalf) {
  // Both lie exactly on mu -+ sigma up to rounding: never 0/0, never beyond.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-6, 6);
  for (int i = 0; i < 1000; ++i) {
    const double a = std::pow(10, exponent(random));
    const double b = a * (1 + std::pow(10, exponent(random)));
    if (b - a <= 4e-6 * a) continue;
    const std::vector<double> rated = relative_densities(std::vector<double>{b, a});
    EXPECT_NEAR(rated[0], 0.5, 1e-9) << a << ' ' << b;
    EXPECT_NEAR(rated[1], -0.5, 1e-9) << a << ' ' << b;
    EXPECT_LE(std::abs(rated[0]), 0.5);
    EXPECT_LE(std::abs(rated[1]), 0.5);
  }
}

TEST(RelativeDensity, JoinsItsThreePiecesAtHalf) {
  // mu = 2, sigma = 1, noise 2e-6: 0.7e-7 above mu + sigma is still on it, 5e-6 above is beyond and thus the
  // maximum.
  const std::vector<double> noise = relative_densities(std::vector<double>{1, 1, 3, 3 + 1e-7});
  EXPECT_NEAR(noise[2], 0.5, 1e-6);
  EXPECT_EQ(noise[3], 0.5);
  const std::vector<double> beyond = relative_densities(std::vector<double>{1, 1, 3, 3 + 1e-5});
  EXPECT_NEAR(beyond[2], 0.5, 1e-5);
  EXPECT_EQ(beyond[3], 1);
  const std::vector<double> below = relative_densities(std::vector<double>{1 - 1e-5, 1, 3, 3});
  EXPECT_EQ(below[0], -1);
  EXPECT_NEAR(below[1], -0.5, 1e-5);
}

TEST(RelativeDensity, OneOutlierTakesTheWholeUpperRange) {
  std::vector<double> densities(100, 1.0);
  densities.push_back(1000);
  const std::vector<double> rated = relative_densities(densities);
  EXPECT_EQ(rated.back(), 1);
  EXPECT_NEAR(rated[0], -0.05, 1e-9);  // (1 - mu) / (2 sigma) = -1 / (2 sqrt(100))
}

TEST(RelativeDensity, IsMonotoneWithinItsRange) {
  std::mt19937_64 random(11);
  std::lognormal_distribution<double> distribution(0, 2);
  std::vector<double> densities(2000);
  for (double& density : densities) density = distribution(random);
  std::sort(densities.begin(), densities.end());
  const std::vector<double> rated = relative_densities(densities);
  EXPECT_TRUE(std::is_sorted(rated.begin(), rated.end()));
  EXPECT_GE(rated.front(), -1);
  EXPECT_EQ(rated.back(), 1);
}

TEST(RelativeDensity, DoesNotDependOnTheUnit) {
  const std::vector<double> expected = relative_densities(kDensities);
  for (const double unit : {1e-300, 1e-70, 1e-9, 1e6, 1e70, 1e300}) {
    std::vector<double> densities = kDensities;
    for (double& density : densities) density *= unit;
    EXPECT_THAT(relative_densities(densities), Pointwise(DoubleNear(1e-12), expected)) << unit;
    EXPECT_NEAR(density_statistics(densities).deviation / unit, 0.215309, 1e-6) << unit;
  }
}

TEST(RelativeDensity, OfAMillionMeshes) {
  std::vector<double> densities(1'000'000);
  for (std::size_t i = 0; i < densities.size(); ++i) densities[i] = 1 + static_cast<double>(i % 1000);
  const DensityStatistics statistics = density_statistics(densities);
  EXPECT_NEAR(statistics.mean, 500.5, 1e-9);
  EXPECT_NEAR(statistics.deviation, std::sqrt((1000.0 * 1000 - 1) / 12), 1e-9);
  EXPECT_EQ(relative_densities(densities)[999], 1);
}

TEST(Distance, OfThePrintedDistances) {
  const std::vector<double> rated = distance_ratings(std::vector<double>{1.66838, 1.73882, 1.81755});
  EXPECT_EQ(rated[0], 0);
  EXPECT_NEAR(rated[1], 0.472204, 1e-5);  // printed from unrounded distances
  EXPECT_EQ(rated[2], 1);
}

TEST(Distance, IsHalfWhereNothingDiffers) {
  EXPECT_TRUE(distance_ratings({}).empty());
  EXPECT_THAT(distance_ratings(std::vector<double>{3}), ElementsAre(0.5));
  EXPECT_THAT(distance_ratings(std::vector<double>{0, 0}), ElementsAre(0.5, 0.5));
  EXPECT_THAT(distance_ratings(std::vector<double>{1 - 0.9e-6, 1}), ElementsAre(0.5, 0.5));
  EXPECT_THAT(distance_ratings(std::vector<double>{1 - 1.1e-6, 1}), ElementsAre(0.0, 1.0));
}

TEST(Distance, IsToTheNearestPointOfTheBox) {
  const analysis::Bounds box{{-1, -2, -3}, {1, 2, 3}};
  EXPECT_EQ(distance_to(box, {0, 0, 0}), 0);
  EXPECT_EQ(distance_to(box, {1, 2, 3}), 0);                     // on a corner
  EXPECT_EQ(distance_to(box, {0, 5, 0}), 3);                     // over a face
  EXPECT_DOUBLE_EQ(distance_to(box, {4, -6, 0}), 5);             // beside an edge
  EXPECT_DOUBLE_EQ(distance_to(box, {-2, 4, 5}), 3);             // off a corner: 1, 2, 2
  EXPECT_DOUBLE_EQ(distance_to(box, {3e200, 4e200, 0}), 5e200);  // squares would overflow
}

TEST(Distance, DefaultEyeLooksFromThreeQuarters) {
  // Centre (1, 2, 3), diagonal |(2, 3, 6)| = 7.
  const mesh::Vector3 eye = default_eye({{0, 0.5, 0}, {2, 3.5, 6}});
  EXPECT_NEAR(eye[0], 1 + 1.2 * 7 * 0.6, 1e-12);
  EXPECT_NEAR(eye[1], 2 + 1.2 * 7 * 0.48, 1e-12);
  EXPECT_NEAR(eye[2], 3 + 1.2 * 7 * 0.64, 1e-12);
  // A scene of one point: the eye is there too, and every distance 0.
  EXPECT_EQ(default_eye({{5, 5, 5}, {5, 5, 5}}), (mesh::Vector3{5, 5, 5}));
  EXPECT_TRUE(std::isfinite(default_eye({{-1e307, 0, 0}, {1e307, 0, 0}})[0]));
}

TEST(RenderingTimeRatings, RunFromTheFastestToTheSlowest) {
  EXPECT_EQ(rendering_time_ratings(std::vector<double>{3, 1, 5, 2}), (std::vector<double>{0.5, 0, 1, 0.25}));
  EXPECT_EQ(rendering_time_ratings(std::vector<double>{7, 7}), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(rendering_time_ratings(std::vector<double>{7}), std::vector<double>{0.5});
  EXPECT_TRUE(rendering_time_ratings({}).empty());
}

}  // namespace
}  // namespace scene_analyzer::ratings
