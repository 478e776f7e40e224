#include "pictures/scene_studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "pictures/compose.h"

namespace scene_analyzer::pictures {
namespace {

constexpr std::uint32_t kSamples = 4;  // per pixel

std::string scene_name(std::span<const analysis::AssetAnalysis> assets) {
  const std::string first = std::filesystem::path(assets.front().asset).filename().string();
  if (assets.size() == 1) return first;
  return fmt::format("{} and {} more", first, assets.size() - 1);
}

}  // namespace

SceneStudio::SceneStudio(gpu::Device& device, const RatedScene& scene, const PictureFormat& format)
    : scene_(scene), format_(format), renderer_(device, kSamples) {}

void SceneStudio::set_model(scene_render::SceneModel model) {
  model_.emplace(std::move(model));
  frame();
}

// What the pictures show: the scene as it was analysed, and meshes that were beyond a limit then.
void SceneStudio::frame() {
  bounds_ = scene_.rating.bounds;
  for (std::size_t i = 0; i < scene_.rating.meshes.size(); ++i) {
    const ratings::MeshRating& mesh = scene_.rating.meshes[i];
    const analysis::AssetAnalysis& asset = scene_.assets[mesh.asset];
    const auto box = model_->box(i);
    if (!box || asset.geometries[asset.instances[mesh.instance].geometry].not_analysed.empty()) continue;
    if (!bounds_) bounds_ = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds_->min[axis] = std::min(bounds_->min[axis], box->min[axis]);
      bounds_->max[axis] = std::max(bounds_->max[axis], box->max[axis]);
    }
  }
  if (!bounds_) throw InputError("the scene has no triangle with a place in space");
}

std::optional<FarAway> SceneStudio::far_away() const {
  return format_.target ? std::nullopt : find_far_away(*model_);
}

std::string SceneStudio::name_of(std::size_t row) const {
  const ratings::MeshRating& mesh = scene_.rating.meshes[row];
  const analysis::InstanceAnalysis& instance = scene_.assets[mesh.asset].instances[mesh.instance];
  return fmt::format("mesh {} ({})", row, instance.node.empty() ? instance.mesh : instance.node);
}

// The aggregate depends on the mode; single ratings are there in both.
const ratings::SceneRating& SceneStudio::rating_of(const Content& content) {
  if (content.subject != Subject::kAggregate || content.relative == scene_.options.relative)
    return scene_.rating;
  if (!other_mode_) {
    ratings::Options options = scene_.options;
    options.relative = content.relative;
    other_mode_ = ratings::rate(scene_.assets, options);
  }
  return *other_mode_;
}

std::string SceneStudio::draw(const Content& content, const std::function<void()>& look) {
  const ratings::SceneRating& rating = rating_of(content);
  const std::uint32_t width = format_.width;
  const std::uint32_t rows = format_.height - legend_height(width, format_.height);
  const scene_render::Camera camera = scene_render::make_camera(*bounds_, scene_.options.eye, format_.target,
                                                                static_cast<double>(width) / rows);
  renderer_.set_group_colors(content.map);
  const scene_render::Picture view = renderer_.draw(*model_, camera, looks(content, rating), width, rows);
  const auto marks = mark_small_extremes(content, rating, scene_.assets, camera, width, rows,
                                         mark_radius(width, format_.height));
  Legend legend = make_legend(content, rating, scene_name(scene_.assets));
  if (content.subject == Subject::kPlanarGroups) legend.without_value = has_unknown_groups();
  return compose(view, marks, legend, format_.height, look);
}

bool SceneStudio::has_unknown_groups() const {
  if (!renderer_.can_draw_groups()) return true;
  for (std::size_t i = 0; i < model_->size(); ++i)
    if (model_->box(i) && !model_->instance(i).groups) return true;
  return false;
}

}  // namespace scene_analyzer::pictures
