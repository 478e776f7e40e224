// review_state.h — What a person has chosen to see of a rated scene. Pure functions: no GPU, no window.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "analysis/metric.h"
#include "mesh/scene.h"
#include "pictures/picture_content.h"
#include "ratings/ratings.h"

namespace scene_analyzer::viewer {

inline constexpr double kGreatestWeight = 10;

struct ReviewState {
  analysis::MetricSet computed = analysis::MetricSet().set();  // the others cannot be switched on
  analysis::MetricSet active = analysis::MetricSet().set();    // those switched on, a part of `computed`
  std::array<double, analysis::kMetricCount> weights = {1, 1, 1, 1, 1, 1, 1};  // each 0..kGreatestWeight
  bool relative = false;
  bool planar_groups = false;  // these are shown instead of ratings
  ratings::ColorMap map = ratings::ColorMap::kThesis;
  bool wireframe = false;
  bool emphasize_extremes = false;
  std::optional<std::size_t> selected;  // row of the mesh instance in the scene's rating

  bool operator==(const ReviewState&) const = default;
};

// All metrics that were computed are on.
ReviewState initial_state(analysis::MetricSet computed);
// More of them are known now: those that are new are on, others stay as they are.
void extend(ReviewState& state, analysis::MetricSet computed);

// On for off and off for on, where the metric was computed.
void toggle(ReviewState& state, analysis::Metric metric);

// 0 for metrics that are off; others cut to 0..kGreatestWeight, 0 for what is no number.
std::array<double, analysis::kMetricCount> effective_weights(const ReviewState& state);

// Metrics that are off keep their ratings, so that a table of the scene is whole, but weigh nothing. When
// nothing weighs, no mesh has an aggregate.
ratings::Options rating_options(const ReviewState& state, const mesh::Vector3& eye);

// Planar groups where they were chosen. Else the aggregate; of a single metric that weighs, the metric
// itself, which is the same value under its own name; and own colours where nothing weighs.
pictures::Content content_of(const ReviewState& state);

// What is seen, for a title: "R_pppg + 2 R_rd, relative", "planar groups", "own colours".
std::string describe(const ReviewState& state);

// "thesis", "viridis", "cividis", "coolwarm", as on the command line.
const char* name_of(ratings::ColorMap map);

}  // namespace scene_analyzer::viewer
