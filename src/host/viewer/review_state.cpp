#include "viewer/review_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace scene_analyzer::viewer {
namespace {

using analysis::kMetricCount;
using analysis::Metric;

std::vector<Metric> weighing(const ReviewState& state) {
  const auto weights = effective_weights(state);
  std::vector<Metric> metrics;
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (weights[i] > 0) metrics.push_back(static_cast<Metric>(i));
  return metrics;
}

}  // namespace

ReviewState initial_state(analysis::MetricSet computed) {
  ReviewState state;
  state.computed = state.active = computed;
  return state;
}

void extend(ReviewState& state, analysis::MetricSet computed) {
  state.active |= computed & ~state.computed;
  state.computed |= computed;
}

void toggle(ReviewState& state, Metric metric) {
  if (state.computed[index_of(metric)]) state.active.flip(index_of(metric));
}

std::array<double, kMetricCount> effective_weights(const ReviewState& state) {
  std::array<double, kMetricCount> weights{};
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (state.active[i] && state.computed[i] && state.weights[i] > 0)
      weights[i] = std::min(state.weights[i], kGreatestWeight);
  return weights;
}

ratings::Options rating_options(const ReviewState& state, const mesh::Vector3& eye) {
  return {
      .metrics = state.computed, .weights = effective_weights(state), .relative = state.relative, .eye = eye};
}

pictures::Content content_of(const ReviewState& state) {
  pictures::Content content;
  content.relative = state.relative;
  content.map = state.map;
  content.emphasize_extremes = state.emphasize_extremes;
  const std::vector<Metric> metrics = weighing(state);
  if (state.planar_groups) {
    content.subject = pictures::Subject::kPlanarGroups;
  } else if (metrics.empty()) {
    content.subject = pictures::Subject::kOwnColors;
  } else if (metrics.size() == 1) {
    content.subject = pictures::Subject::kMetric;
    content.metric = metrics.front();
  } else {
    content.subject = pictures::Subject::kAggregate;
  }
  return content;
}

std::string describe(const ReviewState& state) {
  if (state.planar_groups) return "planar groups";
  const auto weights = effective_weights(state);
  std::string sum;
  for (const Metric metric : weighing(state)) {
    if (!sum.empty()) sum += " + ";
    const double weight = weights[index_of(metric)];
    if (weight != 1) sum += fmt::format("{:.3g} ", weight);
    sum += analysis::kMetricSymbols[index_of(metric)];
  }
  if (sum.empty()) return "own colours";
  return sum + (state.relative ? ", relative" : ", absolute");
}

const char* name_of(ratings::ColorMap map) {
  switch (map) {
    case ratings::ColorMap::kThesis:
      return "thesis";
    case ratings::ColorMap::kViridis:
      return "viridis";
    case ratings::ColorMap::kCividis:
      return "cividis";
    case ratings::ColorMap::kCoolwarm:
      break;
  }
  return "coolwarm";
}

}  // namespace scene_analyzer::viewer
