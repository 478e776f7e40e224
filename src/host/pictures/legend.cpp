#include "pictures/legend.h"

#include <fmt/format.h>

#include <algorithm>

namespace scene_analyzer::pictures {
namespace {

std::string counts(const ratings::SceneRating& rating, const std::string& scene) {
  const auto count = [](std::uint64_t number, const char* one, const char* many) {
    return fmt::format("{} {}", fmt::group_digits(number), number == 1 ? one : many);
  };
  return fmt::format("{}: {}, {}", scene, count(rating.meshes.size(), "mesh", "meshes"),
                     count(rating.drawn_triangles, "triangle", "triangles"));
}

void add_groups(const Content& content, Legend& legend) {
  legend.bar = [map = content.map](double along) { return ratings::color(along, map); };
  legend.ticks = {{0, "a triangle alone"}, {1, "the mesh's largest group"}};
}

void add_values(const Content& content, const ratings::SceneRating& rating, Legend& legend) {
  const bool is_signed_range = is_signed(content, rating);
  const double least = is_signed_range ? -1 : 0;
  const auto along = [least](double value) { return std::clamp((value - least) / (1 - least), 0.0, 1.0); };
  legend.bar = [map = content.map, least, is_signed_range](double place) {
    return ratings::color(least + place * (1 - least), map, is_signed_range);
  };
  if (is_signed_range)
    legend.ticks = {{0, "-1"}, {0.25, "-0.5"}, {0.5, "0"}, {0.75, "0.5"}, {1, "1"}};
  else
    legend.ticks = {{0, "0"}, {0.25, "0.25"}, {0.5, "0.5"}, {0.75, "0.75"}, {1, "1"}};
  const std::vector<std::optional<double>> shown = values(content, rating);
  const auto less = [](const auto& a, const auto& b) { return a && (!b || *a < *b); };  // absent last
  const auto greater = [](const auto& a, const auto& b) { return a && (!b || *a > *b); };
  legend.without_value = std::ranges::any_of(shown, [](const auto& value) { return !value; });
  if (shown.empty()) return;
  const auto lowest = *std::ranges::min_element(shown, less),
             highest = *std::ranges::min_element(shown, greater);
  std::string range = content.relative ? "relative" : "absolute";
  if (lowest) {
    legend.present = {along(*lowest), along(*highest)};
    range += fmt::format(", {:.4g} to {:.4g} in this scene", *lowest, *highest);
    if (content.emphasize_extremes) range += fmt::format("; below {:.4g} transparent", *least_extreme(shown));
  }
  legend.lines.push_back(range);
}

}  // namespace

Legend make_legend(const Content& content, const ratings::SceneRating& rating, const std::string& scene) {
  Legend legend;
  legend.title = title(content);
  if (content.subject == Subject::kPlanarGroups) add_groups(content, legend);
  if (content.subject == Subject::kMetric || content.subject == Subject::kAggregate)
    add_values(content, rating, legend);
  legend.lines.push_back(counts(rating, scene));
  return legend;
}

}  // namespace scene_analyzer::pictures
