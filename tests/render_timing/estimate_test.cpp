// From repeated times to one figure and how sure it is.
#include "render_timing/estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace scene_analyzer::render_timing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Samples samples_of(const std::vector<std::vector<double>>& rounds) {
  Samples samples(static_cast<std::uint32_t>(rounds.front().size()));
  for (const auto& round : rounds)
    for (const double value : round) samples.add(value);
  return samples;
}

TEST(Median, OfOddEvenAndMissingValues) {
  const auto of = [](std::vector<double> values) { return median(values); };
  EXPECT_EQ(of({3, 1, 2}), 2);
  EXPECT_EQ(of({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(of({kNan, 7, kNan}), 7);
  EXPECT_TRUE(std::isnan(of({})));
  EXPECT_TRUE(std::isnan(of({kNan})));
}

TEST(Estimate, IsTheMeanOfTheRotationsMedians) {
  const auto found = estimate(samples_of({{10, 100}, {12, 5000}, {11, 90}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mean, (11 + 100) / 2.0);
  EXPECT_EQ(found->fastest, 11);
  EXPECT_EQ(found->slowest, 100);
  EXPECT_EQ(found->confidence, std::nullopt) << "three rounds say little about their spread";
}

TEST(Estimate, AFewBrokenTimesAreLeftOut) {
  const auto found = estimate(samples_of({{10, kNan}, {kNan, 30}, {14, 20}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mean, (12 + 25) / 2.0);
  EXPECT_EQ(estimate(samples_of({{10, kNan}, {10, kNan}})), std::nullopt);
  EXPECT_EQ(estimate(Samples(4)), std::nullopt);
}

TEST(Estimate, RoundsThatAgreeAreSure) {
  EXPECT_EQ(estimate(samples_of({{5, 7}, {5, 7}, {5, 7}, {5, 7}, {5, 7}}))->confidence, 0);
  // Medians of deviations do not see a round that something else disturbed.
  EXPECT_EQ(estimate(samples_of({{5, 7}, {5, 7}, {500, 700}, {5, 7}, {5, 7}}))->confidence, 0);
}

// Whole rounds drift together, as they do when a machine changes its clock: the interval has to hold the
// truth about as often as it says.
TEST(Estimate, IntervalsHoldTheTruthAboutNineteenTimesOutOfTwenty) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  for (const std::uint32_t rounds : {5U, 10U, 40U}) {
    int held = 0;
    constexpr int kTrials = 2000;
    for (int trial = 0; trial < kTrials; ++trial) {
      Samples samples(8);
      for (std::uint32_t round = 0; round < rounds; ++round) {
        const double drift = 5 * noise(random);
        for (int rotation = 0; rotation < 8; ++rotation) samples.add(1000 + drift + noise(random));
      }
      const auto found = estimate(samples);
      held += std::abs(found->mean - 1000) <= *found->confidence ? 1 : 0;
    }
    EXPECT_GE(held, kTrials * 90 / 100) << rounds;
    EXPECT_LE(held, kTrials * 99 / 100) << rounds;
  }
}

}  // namespace
}  // namespace scene_analyzer::render_timing
