#include "scene_render/scene_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "gpu/error.h"

namespace scene_analyzer::scene_render {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMostTriangles = kNone / 14;  // of 14 words each: places of words have 32 bits
// Devices allow some thousand allocations, so small meshes share one; a larger mesh has one of its own.
constexpr std::size_t kPageWords = std::size_t{16} << 20;

std::vector<std::uint32_t> as_words(const std::vector<float>& numbers) {
  std::vector<std::uint32_t> words(numbers.size());
  std::transform(numbers.begin(), numbers.end(), words.begin(),
                 [](float number) { return std::bit_cast<std::uint32_t>(number); });
  return words;
}

}  // namespace

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

void SceneModelBuilder::add(const mesh::Scene& scene, std::span<const GroupShades* const> groups) {
  add_textures(scene);
  std::vector<std::uint32_t> number(scene.meshes.size(), kNone);
  std::map<const GroupShades*, std::optional<std::uint32_t>> group_number;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const mesh::Instance& from = scene.instances[i];
    const mesh::TriangleMesh& geometry = scene.meshes[from.mesh];
    const mesh::Material& material = scene.materials[geometry.material];
    SceneModel::Instance& added = model_.instances_.emplace_back();
    added.world = from.world;
    added.own_color = material.base_color;
    if (material.texture && texture_number_[*material.texture] != kNone &&
        !geometry.texture_coordinates.empty())
      added.texture = texture_number_[*material.texture];
    if (number[from.mesh] == kNone) number[from.mesh] = add_mesh(geometry, added.texture.has_value());
    added.mesh = number[from.mesh];
    if (groups.empty() || groups[i] == nullptr) continue;
    const auto [known, is_new] = group_number.try_emplace(groups[i]);
    if (is_new) known->second = add_groups(*groups[i]);
    added.groups = known->second;
  }
}

void SceneModelBuilder::add_textures(const mesh::Scene& scene) {
  texture_number_.assign(scene.textures.size(), kNone);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const mesh::Texture& texture = scene.textures[i];
    if (texture.pixels.empty()) continue;
    texture_number_[i] = static_cast<std::uint32_t>(model_.textures_.size());
    model_.textures_.push_back(
        device_.make_texture(texture.path, texture.width, texture.height, texture.pixels));
  }
}

// The byte where the words begin.
std::uint64_t SceneModelBuilder::append(std::span<const std::uint32_t> words) {
  const std::uint64_t begin = page_.size() * sizeof(std::uint32_t);
  page_.insert(page_.end(), words.begin(), words.end());
  return begin;
}

std::uint32_t SceneModelBuilder::add_mesh(const mesh::TriangleMesh& mesh, bool textured) {
  const DrawableMesh drawable = make_drawable(mesh, textured);
  if (drawable.triangles > kMostTriangles)
    throw gpu::OutOfMemory("mesh \"" + mesh.name + "\" has " + std::to_string(drawable.triangles) +
                           " triangles, one that is drawn at most " + std::to_string(kMostTriangles));
  if (page_.size() + drawable.bytes() / sizeof(std::uint32_t) > kPageWords) flush_page();
  SceneModel::Slot& slot = model_.slots_.emplace_back();
  model_.triangles_ += drawable.triangles;
  slot.page = static_cast<std::uint32_t>(model_.pages_.size());
  slot.center = drawable.center;
  slot.half = drawable.half;
  slot.radius = drawable.radius;
  slot.texture_low = drawable.texture_low;
  slot.texture_range = drawable.texture_range;
  slot.corners = static_cast<std::uint32_t>(3 * drawable.triangles);
  slot.positions = append(as_words(drawable.positions));
  if (!drawable.normals.empty()) slot.normals = append(drawable.normals);
  if (!drawable.texture_positions.empty()) slot.texture_positions = append(drawable.texture_positions);
  if (!drawable.indices.empty())
    slot.first_index = static_cast<std::uint32_t>(append(drawable.indices) / sizeof(std::uint32_t));
  return static_cast<std::uint32_t>(model_.slots_.size() - 1);
}

std::optional<std::uint32_t> SceneModelBuilder::add_groups(const GroupShades& groups) {
  const std::uint64_t most = device_.info().max_storage_buffer_bytes;
  if (groups.empty() || groups.size() > most) return std::nullopt;
  if (group_page_.size() + groups.size() > std::min<std::uint64_t>(most, 4 * kPageWords)) flush_groups();
  model_.group_slots_.push_back({.page = static_cast<std::uint32_t>(model_.group_pages_.size()),
                                 .first = static_cast<std::uint32_t>(group_page_.size())});
  group_page_.insert(group_page_.end(), groups.begin(), groups.end());
  return static_cast<std::uint32_t>(model_.group_slots_.size() - 1);
}

void SceneModelBuilder::flush_page() {
  if (page_.empty()) return;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(page_));
  const gpu::Buffer& buffer = model_.pages_.emplace_back(
      device_.make_vertex_buffer("meshes to draw " + std::to_string(model_.pages_.size()), bytes.size()));
  device_.upload(buffer, 0, bytes);
  model_.bytes_ += bytes.size();
  page_.clear();
}

void SceneModelBuilder::flush_groups() {
  if (group_page_.empty()) return;
  group_page_.resize((group_page_.size() + 3) / 4 * 4);
  const auto& array = model_.group_pages_.emplace_back(
      device_, "planar groups to draw " + std::to_string(model_.group_pages_.size()), group_page_.size() / 4);
  device_.upload(array.buffer(), 0, std::as_bytes(std::span(group_page_)));
  model_.bytes_ += group_page_.size();
  group_page_.clear();
}

SceneModel SceneModelBuilder::finish() {
  flush_page();
  flush_groups();
  return std::exchange(model_, {});
}

}  // namespace scene_analyzer::scene_render
