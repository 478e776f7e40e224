// scene_model.h — The meshes of a scene on the device, ready to be drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "mesh/scene.h"
#include "scene_render/drawable_mesh.h"

namespace scene_analyzer::scene_render {

// How large the planar groups of one mesh's triangles are: 0 for a triangle alone to 255 for the largest
// group.
using GroupShades = std::vector<std::uint8_t>;
// `sizes`: per triangle, of its group.
GroupShades shade_groups(std::span<const std::uint32_t> sizes);

class SceneModel {
 public:
  // One mesh instance, in the scene's order.
  struct Instance {
    std::uint32_t mesh = 0;
    mesh::Matrix4 world = mesh::kIdentity4;
    std::optional<std::array<float, 4>> own_color;  // of its material, [0,1]; absent: it has none
    std::optional<std::uint32_t> texture;
    std::optional<std::uint32_t> groups;  // where its triangles' groups are known
  };

  std::size_t size() const { return instances_.size(); }
  const Instance& instance(std::size_t index) const { return instances_[index]; }
  bool has_own_color(std::size_t index) const;
  // World, around the corners of its mesh's box: as small as possible where it is not turned. Absent where
  // nothing is drawn, or not at a finite place.
  std::optional<analysis::Bounds> box(std::size_t index) const;

  // Memory on the device for vertices, indices and groups: at most 56 per triangle of a mesh, and one
  // per triangle of every GroupShades; textures are not counted.
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t triangles() const { return triangles_; }  // of all meshes, each once

  // All instances of `other` follow those that are here. Cost: none per triangle.
  void append(SceneModel&& other);

 private:
  friend class SceneModelBuilder;
  friend class SceneRenderer;

  // Where a mesh lies in `pages_[page]`; an absent part is none of it.
  struct Slot {
    std::size_t page = 0;
    std::uint64_t positions = 0;  // bytes
    std::optional<std::uint64_t> normals, texture_positions;
    std::optional<std::uint32_t> first_index;
    std::uint32_t corners = 0;       // 0: nothing is drawn
    mesh::Vector3 center{}, half{};  // of its box, as in the file
    double radius = 1;
    std::array<double, 2> texture_low{}, texture_range{};
  };
  struct GroupSlot {
    std::size_t page = 0;
    std::uint32_t first = 0;  // byte within group_pages_[page]
  };

  std::vector<gpu::Buffer> pages_;
  std::vector<gpu::Array<std::uint32_t>> group_pages_;
  std::vector<Slot> slots_;
  std::vector<GroupSlot> group_slots_;
  std::vector<gpu::Texture> textures_;
  std::vector<Instance> instances_;
  std::uint64_t bytes_ = 0, triangles_ = 0;
};

}  // namespace scene_analyzer::scene_render
