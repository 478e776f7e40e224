// What is chosen, and what ratings and pictures make of it.
#include "viewer/review_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "viewer/rated_assets.h"

namespace scene_analyzer::viewer {
namespace {

using analysis::kMetricCount;
using analysis::Metric;
using analysis::MetricSet;
using pictures::Subject;

constexpr std::size_t kDensity = index_of(Metric::kRelativeDensity);

ratings::SceneRating rate(const ReviewState& state) {
  const analysis::AssetAnalysis asset = test::rated_asset();
  return ratings::rate({&asset, 1}, rating_options(state, {0, 0, 20}));
}

TEST(ReviewState, MetricsThatComeLaterAreOnAndOthersStay) {
  using analysis::Metric;
  const auto both = [] {
    return analysis::MetricSet().set(index_of(Metric::kDistance)).set(index_of(Metric::kRenderingTime));
  };
  ReviewState state = initial_state(analysis::MetricSet().set(index_of(Metric::kDistance)));
  toggle(state, Metric::kDistance);
  extend(state, both());
  EXPECT_EQ(state.computed, both());
  EXPECT_EQ(state.active, analysis::MetricSet().set(index_of(Metric::kRenderingTime)));
}

TEST(ReviewState, AtFirstAllIsOnThatWasComputed) {
  MetricSet computed = MetricSet().set();
  computed.reset(index_of(Metric::kRenderingTime));
  const ReviewState state = initial_state(computed);
  EXPECT_EQ(state.active, computed);
  for (const double weight : state.weights) EXPECT_EQ(weight, 1);
  EXPECT_EQ(state.selected, std::nullopt);
  EXPECT_EQ(ReviewState(), initial_state(MetricSet().set()));
}

TEST(ReviewState, OnlyWhatWasComputedIsSwitched) {
  ReviewState state = initial_state(MetricSet().set(0));
  toggle(state, Metric::kDistance);
  EXPECT_EQ(state.active, MetricSet().set(0));
  toggle(state, Metric::kPolygonsPerPlanarGroup);
  EXPECT_TRUE(state.active.none());
  toggle(state, Metric::kPolygonsPerPlanarGroup);
  EXPECT_EQ(state.active, MetricSet().set(0));
}

// Every combination: weights, aggregates against the rule of the ratings room, subject.
TEST(ReviewState, AllCombinationsOfMetricsAreRated) {
  for (unsigned long bits = 0; bits < 128; ++bits)
    for (const bool relative : {false, true}) {
      ReviewState state;
      state.active = MetricSet(bits);
      state.weights = {1, 2, 3, 0.5, 10, 1, 4};
      state.relative = relative;
      const ratings::Options options = rating_options(state, {1, 2, 3});
      EXPECT_EQ(options.eye, (mesh::Vector3{1, 2, 3}));
      EXPECT_EQ(options.relative, relative);
      EXPECT_TRUE(options.metrics.all());
      for (std::size_t i = 0; i < kMetricCount; ++i)
        EXPECT_EQ(options.weights[i], state.active[i] ? state.weights[i] : 0);

      const ratings::SceneRating rating = rate(state);
      ratings::Options alone = rating_options(state, {0, 0, 20});
      alone.metrics = state.active;  // as if the others had never been measured
      const analysis::AssetAnalysis asset = test::rated_asset();
      const ratings::SceneRating expected = ratings::rate({&asset, 1}, alone);
      const pictures::Content content = content_of(state);
      const auto shown = pictures::values(content, rating);
      EXPECT_EQ(rating.signed_aggregate, bits == 1UL << kDensity);
      EXPECT_EQ(content.relative, relative);
      EXPECT_EQ(content.subject, bits == 0                   ? Subject::kOwnColors
                                 : state.active.count() == 1 ? Subject::kMetric
                                                             : Subject::kAggregate);
      EXPECT_TRUE(bits == 0 || pictures::is_signed(content, rating) == rating.signed_aggregate);
      for (std::size_t mesh = 0; mesh < 3; ++mesh) {
        ASSERT_EQ(rating.meshes[mesh].aggregate.has_value(), bits != 0);
        for (const auto& value : rating.meshes[mesh].ratings) EXPECT_TRUE(value) << "the table stays whole";
        if (bits == 0) continue;
        EXPECT_EQ(*rating.meshes[mesh].aggregate, *expected.meshes[mesh].aggregate);
        EXPECT_NEAR(shown[mesh].value(), *rating.meshes[mesh].aggregate, 1e-12);
      }
    }
}

TEST(ReviewState, ASingleMetricHasItsName) {
  ReviewState state;
  state.active = MetricSet().set(kDensity);
  EXPECT_EQ(pictures::title(content_of(state)), "Relative density");
  // The other one weighs nothing.
  state.active.set(0);
  state.weights[0] = 0;
  EXPECT_EQ(content_of(state).metric, Metric::kRelativeDensity);
  EXPECT_EQ(content_of(state).subject, Subject::kMetric);
}

TEST(ReviewState, WhatWeighsNothingIsNotShown) {
  ReviewState state;
  state.weights.fill(0);
  EXPECT_EQ(content_of(state).subject, Subject::kOwnColors);
  EXPECT_EQ(describe(state), "own colours");
  for (const auto& mesh : rate(state).meshes) EXPECT_FALSE(mesh.aggregate);
  state.weights[1] = 0.25;
  EXPECT_EQ(content_of(state).metric, Metric::kPlanarGroupVariation);
}

TEST(ReviewState, WeightsStayInTheirRange) {
  ReviewState state;
  state.weights = {-1, std::nan(""), 1e300, 10, 0, 1, 2};
  const std::array<double, 7> expected = {0, 0, 10, 10, 0, 1, 2};
  EXPECT_EQ(effective_weights(state), expected);
  state.computed.reset(6);
  EXPECT_EQ(effective_weights(state)[6], 0) << "on, but never computed";
}

TEST(ReviewState, ContentHasTheChoices) {
  ReviewState state;
  state.map = ratings::ColorMap::kCividis;
  state.emphasize_extremes = true;
  state.planar_groups = true;
  const pictures::Content content = content_of(state);
  EXPECT_EQ(content.subject, Subject::kPlanarGroups);
  EXPECT_EQ(content.map, ratings::ColorMap::kCividis);
  EXPECT_TRUE(content.emphasize_extremes);
  state.active.reset();
  EXPECT_EQ(content_of(state).subject, Subject::kPlanarGroups) << "whatever is on";
}

TEST(ReviewState, SaysWhatIsSeen) {
  ReviewState state;
  state.active = MetricSet().set(0).set(kDensity);
  state.weights[kDensity] = 2;
  state.relative = true;
  EXPECT_EQ(describe(state), "R_pppg + 2 R_rd, relative");
  state.relative = false;
  state.weights[0] = 0.123456;
  EXPECT_EQ(describe(state), "0.123 R_pppg + 2 R_rd, absolute");
  state.planar_groups = true;
  EXPECT_EQ(describe(state), "planar groups");
  EXPECT_EQ(describe(initial_state({})), "own colours");
}

TEST(ReviewState, MapsHaveNames) {
  using ratings::ColorMap;
  EXPECT_STREQ(name_of(ColorMap::kThesis), "thesis");
  EXPECT_STREQ(name_of(ColorMap::kViridis), "viridis");
  EXPECT_STREQ(name_of(ColorMap::kCividis), "cividis");
  EXPECT_STREQ(name_of(ColorMap::kCoolwarm), "coolwarm");
}

}  // namespace
}  // namespace scene_analyzer::viewer
