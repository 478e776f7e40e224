// Aggregate and relative mode, with all seven ratings made up, also those that no version computes yet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

using Weights = std::array<double, analysis::kMetricCount>;
constexpr std::size_t kPppg = 0, kPgv = 1, kRd = 2, kD = 3, kCcm = 4, kFt = 5, kRt = 6;
constexpr Weights kOnes = {1, 1, 1, 1, 1, 1, 1};

OptionalRatings only(std::size_t metric, double value) {
  OptionalRatings row;
  row[metric] = value;
  return row;
}

TEST(Aggregate, IsTheMeanOfAllSevenWithTheMagnitudeOfDensity) {
  const OptionalRatings row = {0.1, 0.2, -0.9, 0.4, 0.5, 0.6, 0.7};
  EXPECT_DOUBLE_EQ(*aggregate(row, kOnes), (0.1 + 0.2 + 0.9 + 0.4 + 0.5 + 0.6 + 0.7) / 7);
}

TEST(Aggregate, WeighsByTheGivenWeights) {
  const OptionalRatings row = {0.1, 0.2, -0.9, 0.4, 0.5, 0.6, 0.7};
  EXPECT_DOUBLE_EQ(*aggregate(row, {0, 0, 1, 0, 0, 0, 3}), (0.9 + 3 * 0.7) / 4);
  EXPECT_DOUBLE_EQ(*aggregate(row, {0, 0.25, 0, 0, 0.75, 0, 0}), 0.25 * 0.2 + 0.75 * 0.5);
  EXPECT_DOUBLE_EQ(*aggregate(row, {0, 0, 0, 0, 0, 5, 0}), 0.6);
}

TEST(Aggregate, LeavesNullsOutOfBothSums) {
  OptionalRatings row = {0.1, 0.2, -0.9, 0.4, 0.5, std::nullopt, std::nullopt};
  EXPECT_DOUBLE_EQ(*aggregate(row, kOnes), (0.1 + 0.2 + 0.9 + 0.4 + 0.5) / 5);
  EXPECT_EQ(aggregate(OptionalRatings{}, kOnes), std::nullopt);
  EXPECT_EQ(aggregate(row, {0, 0, 0, 0, 0, 1, 1}), std::nullopt);  // only the nulls have weight
}

TEST(Aggregate, DensityAloneKeepsItsSign) {
  const OptionalRatings row = {0.1, 0.2, -0.9, 0.4, 0.5, 0.6, 0.7};
  EXPECT_DOUBLE_EQ(*aggregate(row, {0, 0, 2, 0, 0, 0, 0}), -0.9);
  EXPECT_DOUBLE_EQ(*aggregate(only(kRd, -0.9), kOnes), -0.9);  // the others were not asked for
  EXPECT_DOUBLE_EQ(*aggregate(row, {1, 0, 1, 0, 0, 0, 0}), 0.5);
}

TEST(Aggregate, OfExtremeWeightsStaysFinite) {
  const OptionalRatings row = {0.25, 0.75, std::nullopt, 1, 0, 1, 0};
  EXPECT_DOUBLE_EQ(*aggregate(row, {1e308, 1e308, 1e308, 0, 0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(*aggregate(row, {5e-324, 5e-324, 0, 0, 0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(*aggregate(row, {1e308, 5e-324, 0, 0, 0, 0, 0}), 0.25);
}

TEST(Aggregates, DecideAboutTheSignOnceForTheScene) {
  // The second mesh has nothing but R_rd, yet its scene combines: no sign in one row only.
  const std::vector<OptionalRatings> scene = {{0.5, {}, -0.5, {}, {}, {}, {}}, only(kRd, -0.8)};
  const auto combined = aggregates(scene, {});
  EXPECT_DOUBLE_EQ(*combined[0], 0.5);
  EXPECT_DOUBLE_EQ(*combined[1], 0.8);
  EXPECT_FALSE(density_stands_alone(scene, kOnes));
  EXPECT_TRUE(density_stands_alone(scene, {0, 0, 1, 0, 0, 0, 1}));  // nobody has an R_rt
  EXPECT_FALSE(density_stands_alone(std::vector<OptionalRatings>{only(kPppg, 1)}, {0, 0, 1, 0, 0, 0, 0}));
  EXPECT_FALSE(density_stands_alone({}, kOnes));
}

TEST(Relative, MapsEachMetricOntoItsRange) {
  const std::vector<OptionalRatings> scene = {{0.2, 0.0, -0.5, 0.3, 0.1, 0.4, 0.2},
                                              {0.4, 0.5, 0.1, 0.5, 0.2, 0.5, 0.3},
                                              {0.6, 0.8, 0.5, 0.6, 0.5, 0.8, 0.9}};
  const auto mapped = relative_ratings(scene);
  EXPECT_DOUBLE_EQ(*mapped[0][kPppg], 0);
  EXPECT_DOUBLE_EQ(*mapped[1][kPppg], 0.5);
  EXPECT_DOUBLE_EQ(*mapped[2][kPppg], 1);
  EXPECT_DOUBLE_EQ(*mapped[1][kPgv], 0.625);
  EXPECT_DOUBLE_EQ(*mapped[0][kRd], -1);
  EXPECT_NEAR(*mapped[1][kRd], 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(*mapped[2][kRd], 1);
  EXPECT_DOUBLE_EQ(*mapped[1][kCcm], 0.25);
  EXPECT_NEAR(*mapped[1][kFt], 0.25, 1e-15);
  for (std::size_t i = 0; i < 3; ++i) {  // relative by definition
    EXPECT_EQ(mapped[i][kD], scene[i][kD]);
    EXPECT_EQ(mapped[i][kRt], scene[i][kRt]);
  }
}

TEST(Relative, OfThePrintedGeospheres) {
  const std::vector<OptionalRatings> scene = {only(kPppg, polygons_per_planar_group(8000, 8000)),
                                              only(kPppg, polygons_per_planar_group(8006, 8002)),
                                              only(kPppg, polygons_per_planar_group(8010, 8005))};
  EXPECT_EQ(*scene[0][kPppg], 0);
  EXPECT_NEAR(*scene[1][kPppg], 0.0005, 5e-7);
  EXPECT_NEAR(*scene[2][kPppg], 0.00062, 5e-6);
  const auto mapped = relative_ratings(scene);
  EXPECT_EQ(*mapped[0][kPppg], 0);
  EXPECT_NEAR(*mapped[1][kPppg], 0.8004, 5e-5);
  EXPECT_EQ(*mapped[2][kPppg], 1);
}

TEST(Relative, LeavesAlmostEqualRatingsAlone) {
  const auto kept = relative_ratings(std::vector<OptionalRatings>{only(kFt, 0.3), only(kFt, 0.3 + 0.9e-5)});
  EXPECT_EQ(*kept[0][kFt], 0.3);
  EXPECT_EQ(*kept[1][kFt], 0.3 + 0.9e-5);
  const auto mapped = relative_ratings(std::vector<OptionalRatings>{only(kFt, 0.3), only(kFt, 0.3 + 1.1e-5)});
  EXPECT_EQ(*mapped[0][kFt], 0);
  EXPECT_EQ(*mapped[1][kFt], 1);
}

TEST(Relative, KeepsNullsNullAndOutOfTheRange) {
  const auto mapped = relative_ratings(std::vector<OptionalRatings>{only(kCcm, 0.2), {}, only(kCcm, 0.6)});
  EXPECT_EQ(mapped[1], OptionalRatings{});
  EXPECT_EQ(*mapped[0][kCcm], 0);
  EXPECT_EQ(*mapped[2][kCcm], 1);
  EXPECT_EQ(mapped[0][kRt], std::nullopt);
}

TEST(RelativeAggregate, TakesTheMagnitudeOfDensityBeforeMapping) {
  // |R_rd| is 0.8, 0.2, 0.5 and maps to 1, 0, 0.5; mapping first would give |-1|, |0.0769|, |1|.
  std::vector<OptionalRatings> scene = {only(kRd, -0.8), only(kRd, 0.2), only(kRd, 0.5)};
  scene[0][kPppg] = 0.0;
  scene[1][kPppg] = 0.5;
  scene[2][kPppg] = 0.25;
  Options options;
  options.relative = true;
  const auto combined = aggregates(scene, options);
  EXPECT_NEAR(*combined[0], (1 + 0.0) / 2, 1e-12);
  EXPECT_NEAR(*combined[1], (0 + 1.0) / 2, 1e-12);
  EXPECT_NEAR(*combined[2], (0.5 + 0.5) / 2, 1e-12);
  options.relative = false;
  EXPECT_NEAR(*aggregates(scene, options)[0], 0.4, 1e-12);
}

TEST(RelativeAggregate, OfDensityAloneIsSigned) {
  Options options;
  options.relative = true;
  options.weights = {0, 0, 1, 0, 0, 0, 0};
  const auto combined =
      aggregates(std::vector<OptionalRatings>{only(kRd, -0.8), only(kRd, 0.2), only(kRd, -0.3)}, options);
  EXPECT_NEAR(*combined[0], -1, 1e-12);
  EXPECT_NEAR(*combined[1], 1, 1e-12);
  EXPECT_NEAR(*combined[2], 0, 1e-12);
}

TEST(RelativeAggregate, KeepsEqualMagnitudes) {
  // -0.5 and 0.5 have one magnitude: nothing to map, 0.5 stays.
  std::vector<OptionalRatings> scene = {only(kRd, -0.5), only(kRd, 0.5)};
  scene[0][kD] = 0.0;
  scene[1][kD] = 1.0;
  Options options;
  options.relative = true;
  const auto combined = aggregates(scene, options);
  EXPECT_DOUBLE_EQ(*combined[0], 0.25);
  EXPECT_DOUBLE_EQ(*combined[1], 0.75);
}

TEST(RelativeAggregate, WeighsMadeUpFourierAndRenderingTimes) {
  std::vector<OptionalRatings> scene = {only(kFt, 0.2), only(kFt, 0.4)};
  scene[0][kRt] = 0.3;
  scene[1][kRt] = 0.9;
  Options options;
  options.relative = true;
  options.weights = {0, 0, 0, 0, 0, 1, 3};
  const auto combined = aggregates(scene, options);
  EXPECT_NEAR(*combined[0], (0 + 3 * 0.3) / 4, 1e-12);
  EXPECT_NEAR(*combined[1], (1 + 3 * 0.9) / 4, 1e-12);
}

}  // namespace
}  // namespace scene_analyzer::ratings
