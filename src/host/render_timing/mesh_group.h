// mesh_group.h — Meshes that are on the device together, to be drawn in turn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "render_timing/framing.h"

namespace scene_analyzer::render_timing {

// Consecutive meshes [first, end) that fit the device together; one that does not fit at all is a group of
// its own.
struct GroupRange {
  std::size_t first = 0, end = 0;
};
std::vector<GroupRange> group_meshes(std::span<const TimedMesh> meshes, const gpu::DeviceInfo& device);

// Memory on the device: 12 bytes per vertex and 12 per drawn triangle.
class MeshGroup {
 public:
  // Frames and uploads. Throws gpu::OutOfMemory.
  MeshGroup(gpu::Device& device, std::span<const TimedMesh> meshes);

  std::size_t size() const { return parts_.size(); }
  // What draws mesh `index`, valid as long as the group.
  gpu::Recorder::Draw draw_of(std::size_t index) const;

 private:
  struct Part {
    std::uint32_t first_vertex, first_index, index_count;
  };
  gpu::Buffer positions_, indices_;
  std::vector<gpu::BufferRange> inputs_;
  std::vector<Part> parts_;
};

}  // namespace scene_analyzer::render_timing
