#include "render_timing/mesh_group.h"

#include <algorithm>
#include <limits>

namespace scene_analyzer::render_timing {
namespace {

// Of the device's free memory, the part that one group may fill: others want some, too.
constexpr double kMemoryShare = 0.5;
// First vertices are added to indices as signed 32-bit numbers.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::int32_t>::max();

struct Size {
  std::uint64_t vertices = 0, indices = 0;
  Size operator+(const Size& other) const { return {vertices + other.vertices, indices + other.indices}; }
};

Size size_of(const TimedMesh& mesh) {
  return {mesh.positions.size() / 3, mesh.indices.size() - 3 * mesh.left_out.size()};
}

bool fits(const Size& size, const gpu::DeviceInfo& device) {
  const std::uint64_t vertex_bytes = 12 * size.vertices, index_bytes = 4 * size.indices;
  return size.vertices <= kMostVertices && size.indices <= std::numeric_limits<std::uint32_t>::max() &&
         std::max(vertex_bytes, index_bytes) <= device.max_allocation_bytes &&
         static_cast<double>(vertex_bytes + index_bytes) <=
             kMemoryShare * static_cast<double>(device.free_memory_bytes);
}

}  // namespace

std::vector<GroupRange> group_meshes(std::span<const TimedMesh> meshes, const gpu::DeviceInfo& device) {
  std::vector<GroupRange> groups;
  Size size;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Size together = size + size_of(meshes[i]);
    if (groups.empty() || !fits(together, device)) {
      groups.push_back({i, i});
      size = size_of(meshes[i]);
    } else {
      size = together;
    }
    groups.back().end = i + 1;
  }
  return groups;
}

MeshGroup::MeshGroup(gpu::Device& device, std::span<const TimedMesh> meshes) {
  Size all;
  for (const TimedMesh& mesh : meshes) {
    const Size size = size_of(mesh);
    parts_.push_back({static_cast<std::uint32_t>(all.vertices), static_cast<std::uint32_t>(all.indices),
                      static_cast<std::uint32_t>(size.indices)});
    all = all + size;
  }
  positions_ = device.make_vertex_buffer("positions to draw", 12 * all.vertices);
  indices_ = device.make_vertex_buffer("indices to draw", 4 * all.indices);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const FramedMesh framed = frame(meshes[i]);
    device.upload(positions_, std::uint64_t{12} * parts_[i].first_vertex,
                  std::as_bytes(std::span(framed.positions)));
    device.upload(indices_, std::uint64_t{4} * parts_[i].first_index,
                  std::as_bytes(std::span(framed.indices)));
  }
  inputs_.emplace_back(positions_);
}

gpu::Recorder::Draw MeshGroup::draw_of(std::size_t index) const {
  const Part& part = parts_[index];
  return {.inputs = inputs_,
          .indices = &indices_,
          .first_index = part.first_index,
          .index_count = part.index_count,
          .first_vertex = part.first_vertex};
}

}  // namespace scene_analyzer::render_timing
