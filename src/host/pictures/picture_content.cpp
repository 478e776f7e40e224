#include "pictures/picture_content.h"

#include <algorithm>

namespace scene_analyzer::pictures {
namespace {

using scene_render::Look;

constexpr double kGlassOpacity = 0.12;

bool has_values(const Content& content) {
  return content.subject == Subject::kMetric || content.subject == Subject::kAggregate;
}

Look without_values(const Content& content, const ratings::MeshRating&) {
  return {.fill = content.subject == Subject::kPlanarGroups ? Look::Fill::kGroups : Look::Fill::kOwnColor};
}

}  // namespace

std::vector<std::optional<double>> values(const Content& content, const ratings::SceneRating& rating) {
  std::vector<std::optional<double>> result;
  result.reserve(rating.meshes.size());
  for (const ratings::MeshRating& mesh : rating.meshes) {
    std::optional<double> value;
    if (content.subject == Subject::kAggregate) value = mesh.aggregate;
    if (content.subject == Subject::kMetric)
      value = (content.relative ? mesh.relative_ratings : mesh.ratings)[index_of(content.metric)];
    result.push_back(value);
  }
  return result;
}

bool is_signed(const Content& content, const ratings::SceneRating& rating) {
  if (content.subject == Subject::kAggregate) return rating.signed_aggregate;
  return content.subject == Subject::kMetric && content.metric == analysis::Metric::kRelativeDensity;
}

std::optional<double> least_extreme(const std::vector<std::optional<double>>& values) {
  std::optional<double> least, greatest;
  for (const std::optional<double>& value : values) {
    if (!value) continue;
    least = std::min(least.value_or(*value), *value);
    greatest = std::max(greatest.value_or(*value), *value);
  }
  if (!least) return std::nullopt;
  return *greatest - (*greatest - *least) / 4;
}

std::vector<Look> looks(const Content& content, const ratings::SceneRating& rating) {
  std::vector<Look> result;
  result.reserve(rating.meshes.size());
  if (!has_values(content)) {
    for (const ratings::MeshRating& mesh : rating.meshes) result.push_back(without_values(content, mesh));
    return result;
  }
  const std::vector<std::optional<double>> shown = values(content, rating);
  const std::optional<double> extreme = least_extreme(shown);
  const bool is_signed_range = is_signed(content, rating);
  for (const std::optional<double>& value : shown) {
    Look look;
    if (value) {
      look.fill = Look::Fill::kColor;
      look.color = ratings::color(*value, content.map, is_signed_range);
    }
    if (content.emphasize_extremes && (!value || *value < *extreme)) look.opacity = kGlassOpacity;
    result.push_back(look);
  }
  return result;
}

std::string title(const Content& content) {
  switch (content.subject) {
    case Subject::kAggregate:
      return "Aggregate";
    case Subject::kPlanarGroups:
      return "Planar groups";
    case Subject::kOwnColors:
      return "Own colours";
    case Subject::kMetric:
      break;
  }
  return std::string(analysis::kMetricNames[index_of(content.metric)]);
}

}  // namespace scene_analyzer::pictures
