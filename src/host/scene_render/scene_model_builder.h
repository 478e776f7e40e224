// scene_model_builder.h — Scenes -> meshes on the device. What does not fit there is left out and said.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "mesh/scene.h"
#include "scene_render/drawable_mesh.h"
#include "scene_render/scene_model.h"

namespace scene_analyzer::scene_render {

class SceneModelBuilder {
 public:
  explicit SceneModelBuilder(gpu::Device& device) : device_(device) {}

  // Appends all instances of `scene`, which may be gone afterwards. `groups`: empty, or per instance its
  // triangles' groups, null where they are not known. Textures without pixels are left out. A mesh or a
  // texture that is beyond the device or its memory is left out with a warning. Throws gpu::DeviceLost. Cost:
  // linear in the scene; memory on the host some 64 MiB besides one mesh.
  void add(const mesh::Scene& scene, std::span<const GroupShades* const> groups = {});

  // All that was added since the last call.
  SceneModel finish();

  // What was left out since the last call, one sentence per mesh or texture, after a finish().
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  std::uint32_t add_mesh(const mesh::TriangleMesh& mesh, bool textured);
  bool fits(const DrawableMesh& drawable, const std::string& name);
  std::optional<std::uint32_t> add_groups(const GroupShades& groups);
  void add_textures(const mesh::Scene& scene);
  std::uint64_t append(std::span<const std::uint32_t> words);
  void flush_page();
  void leave_out_page(const std::string& why);
  void flush_groups();

  gpu::Device& device_;
  SceneModel model_;
  std::vector<std::uint32_t> page_;            // of the page that is filled
  std::vector<std::string> names_;             // along model_.slots_
  GroupShades group_page_;                     //
  std::vector<std::uint32_t> texture_number_;  // of the scene being added; kNone: it cannot be shown
  std::vector<std::string> warnings_;
};

}  // namespace scene_analyzer::scene_render
