#include "scene_render/scene_model_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <map>

#include "gpu/error.h"

namespace scene_analyzer::scene_render {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kNoPage = std::numeric_limits<std::size_t>::max();
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
    try {
      model_.textures_.push_back(
          device_.make_texture(texture.path, texture.width, texture.height, texture.pixels));
    } catch (const gpu::DeviceLost&) {
      throw;
    } catch (const gpu::Error& error) {
      texture_number_[i] = kNone;
      warnings_.push_back(fmt::format("texture {} is not shown: {}", texture.path, error.what()));
    }
  }
}

// The byte where the words begin.
std::uint64_t SceneModelBuilder::append(std::span<const std::uint32_t> words) {
  const std::uint64_t begin = page_.size() * sizeof(std::uint32_t);
  page_.insert(page_.end(), words.begin(), words.end());
  return begin;
}

// Whether the device can draw it at all; a warning if not.
bool SceneModelBuilder::fits(const DrawableMesh& drawable, const std::string& name) {
  const std::uint64_t vertices = drawable.positions.size() / 3;
  const std::uint64_t most_vertices = std::uint64_t{device_.info().max_index} + 1;
  std::string why;
  if (drawable.triangles > kMostTriangles)
    why =
        fmt::format("it has {} triangles, one that is drawn at most {}", drawable.triangles, kMostTriangles);
  else if (drawable.bytes() > device_.info().max_allocation_bytes)
    why = fmt::format("it needs {} bytes, the device's largest allocation has {}", drawable.bytes(),
                      device_.info().max_allocation_bytes);
  else if (!drawable.indices.empty() && vertices > most_vertices)
    why = fmt::format("it has {} vertices, the device numbers at most {} (maxDrawIndexedIndexValue)",
                      vertices, most_vertices);
  if (!why.empty()) warnings_.push_back(fmt::format("mesh \"{}\" is not drawn: {}", name, why));
  return why.empty();
}

std::uint32_t SceneModelBuilder::add_mesh(const mesh::TriangleMesh& mesh, bool textured) {
  const DrawableMesh drawable = make_drawable(mesh, textured);
  const bool drawn = fits(drawable, mesh.name);
  if (drawn && page_.size() + drawable.bytes() / sizeof(std::uint32_t) > kPageWords) flush_page();
  names_.push_back(mesh.name);
  SceneModel::Slot& slot = model_.slots_.emplace_back();
  slot.page = model_.pages_.size();
  if (!drawn) return static_cast<std::uint32_t>(model_.slots_.size() - 1);
  model_.triangles_ += drawable.triangles;
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
  model_.group_slots_.push_back(
      {.page = model_.group_pages_.size(), .first = static_cast<std::uint32_t>(group_page_.size())});
  group_page_.insert(group_page_.end(), groups.begin(), groups.end());
  return static_cast<std::uint32_t>(model_.group_slots_.size() - 1);
}

void SceneModelBuilder::flush_page() {
  if (page_.empty()) return;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(page_));
  try {
    gpu::Buffer buffer =
        device_.make_vertex_buffer(fmt::format("meshes to draw {}", model_.pages_.size()), bytes.size());
    device_.upload(buffer, 0, bytes);
    model_.pages_.push_back(std::move(buffer));
    model_.bytes_ += bytes.size();
  } catch (const gpu::OutOfMemory& error) {
    leave_out_page(error.what());
  }
  page_.clear();
}

// The meshes of the page that is filled are not drawn; the next page gets its number.
void SceneModelBuilder::leave_out_page(const std::string& why) {
  for (std::size_t i = 0; i < model_.slots_.size(); ++i) {
    SceneModel::Slot& slot = model_.slots_[i];
    if (slot.page != model_.pages_.size() || slot.corners == 0) continue;
    model_.triangles_ -= slot.corners / 3;
    slot.corners = 0;
    warnings_.push_back(fmt::format("mesh \"{}\" is not drawn: {}", names_[i], why));
  }
}

void SceneModelBuilder::flush_groups() {
  if (group_page_.empty()) return;
  group_page_.resize((group_page_.size() + 3) / 4 * 4);
  try {
    gpu::Array<std::uint32_t> array(
        device_, fmt::format("planar groups to draw {}", model_.group_pages_.size()), group_page_.size() / 4);
    device_.upload(array.buffer(), 0, std::as_bytes(std::span(group_page_)));
    model_.group_pages_.push_back(std::move(array));
    model_.bytes_ += group_page_.size();
  } catch (const gpu::OutOfMemory& error) {
    for (SceneModel::GroupSlot& slot : model_.group_slots_)
      if (slot.page == model_.group_pages_.size()) slot.page = kNoPage;
    warnings_.push_back(fmt::format("planar groups of some meshes are not shown: {}", error.what()));
  }
  group_page_.clear();
}

SceneModel SceneModelBuilder::finish() {
  flush_page();
  flush_groups();
  for (SceneModel::Instance& instance : model_.instances_)
    if (instance.groups && model_.group_slots_[*instance.groups].page == kNoPage) instance.groups.reset();
  names_.clear();
  return std::exchange(model_, {});
}

}  // namespace scene_analyzer::scene_render
