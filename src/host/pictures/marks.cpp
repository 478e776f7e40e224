#include "pictures/marks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scene_analyzer::pictures {
namespace {

constexpr std::size_t kMostMarks = 100, kMostNames = 12;

// The ring of one mesh, if it needs one.
std::optional<Mark> mark_of(const analysis::InstanceAnalysis& instance, const scene_render::Camera& camera,
                            std::uint32_t width, std::uint32_t height, double least_radius) {
  if (!instance.bounds) return std::nullopt;
  mesh::Vector3 middle{}, half{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = instance.bounds->min[axis] / 2 + instance.bounds->max[axis] / 2;
    half[axis] = instance.bounds->max[axis] / 2 - instance.bounds->min[axis] / 2;
  }
  const auto place = scene_render::project(camera, static_cast<double>(width) / height, middle);
  if (!place || std::abs(place->x) > 1 || std::abs(place->y) > 1) return std::nullopt;
  const double radius = std::hypot(half[0], half[1], half[2]) * place->unit * height / 2;
  if (!(radius < least_radius)) return std::nullopt;
  return Mark{.x = (1 + place->x) / 2 * width,
              .y = (1 - place->y) / 2 * height,
              .name = instance.node.empty() ? instance.mesh : instance.node};
}

}  // namespace

std::vector<Mark> mark_small_extremes(const Content& content, const ratings::SceneRating& rating,
                                      std::span<const analysis::AssetAnalysis> assets,
                                      const scene_render::Camera& camera, std::uint32_t width,
                                      std::uint32_t height, double least_radius) {
  std::vector<std::pair<double, Mark>> found;
  const std::vector<std::optional<double>> shown = values(content, rating);
  const std::optional<double> extreme = least_extreme(shown);
  if (!content.emphasize_extremes || !extreme) return {};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i] || *shown[i] < *extreme) continue;
    const ratings::MeshRating& mesh = rating.meshes[i];
    auto mark = mark_of(assets[mesh.asset].instances[mesh.instance], camera, width, height, least_radius);
    if (mark) found.emplace_back(*shown[i], std::move(*mark));
  }
  std::ranges::stable_sort(found, std::greater(), &std::pair<double, Mark>::first);
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < std::min(found.size(), kMostMarks); ++i) {
    marks.push_back(std::move(found[i].second));
    if (found.size() > kMostNames) marks.back().name.clear();
  }
  return marks;
}

}  // namespace scene_analyzer::pictures
