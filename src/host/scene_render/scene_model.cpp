#include "scene_render/scene_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace scene_analyzer::scene_render {

GroupShades shade_groups(std::span<const std::uint32_t> sizes) {
  GroupShades shades(sizes.size());
  if (sizes.empty()) return shades;
  const double range = std::max(1.0, static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) - 1);
  std::transform(sizes.begin(), sizes.end(), shades.begin(), [range](std::uint32_t size) {
    return static_cast<std::uint8_t>(size < 2 ? 0 : std::lround(255 * (size - 1) / range));
  });
  return shades;
}

bool SceneModel::has_own_color(std::size_t index) const {
  const Instance& instance = instances_[index];
  return instance.own_color || instance.texture;
}

std::optional<analysis::Bounds> SceneModel::box(std::size_t index) const {
  const Slot& slot = slots_[instances_[index].mesh];
  if (slot.corners == 0) return std::nullopt;
  const mesh::Matrix4& world = instances_[index].world;
  analysis::Bounds box;
  for (std::size_t row = 0; row < 3; ++row) {
    double middle = world[4 * row + 3], half = 0;
    for (std::size_t column = 0; column < 3; ++column) {
      middle += world[4 * row + column] * slot.center[column];
      half += std::abs(world[4 * row + column]) * slot.half[column];
    }
    if (!std::isfinite(middle) || !std::isfinite(half)) return std::nullopt;
    box.min[row] = middle - half;
    box.max[row] = middle + half;
  }
  return box;
}

void SceneModel::append(SceneModel&& other) {
  const auto instances = instances_.size();
  const auto shift = [](std::optional<std::uint32_t>& place, std::size_t by) {
    if (place) *place += static_cast<std::uint32_t>(by);
  };
  for (Slot& slot : other.slots_) slot.page += pages_.size();
  for (GroupSlot& slot : other.group_slots_) slot.page += group_pages_.size();
  std::ranges::move(other.instances_, std::back_inserter(instances_));
  for (Instance& instance : std::span(instances_).subspan(instances)) {
    instance.mesh += static_cast<std::uint32_t>(slots_.size());
    shift(instance.texture, textures_.size());
    shift(instance.groups, group_slots_.size());
  }
  std::ranges::move(other.slots_, std::back_inserter(slots_));
  std::ranges::move(other.group_slots_, std::back_inserter(group_slots_));
  std::ranges::move(other.pages_, std::back_inserter(pages_));
  std::ranges::move(other.group_pages_, std::back_inserter(group_pages_));
  std::ranges::move(other.textures_, std::back_inserter(textures_));
  bytes_ += other.bytes_;
  triangles_ += other.triangles_;
  other = {};
}

}  // namespace scene_analyzer::scene_render
