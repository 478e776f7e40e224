// picking.h — Which mesh is at a pixel.
#pragma once

#include <cstdint>
#include <optional>

#include "gpu/device.h"
#include "scene_render/scene_renderer.h"

namespace scene_analyzer::viewer {

// Draws the scene once more, every mesh in a colour of its own, and looks at one pixel: what is seen there is
// what is picked. Up to 2^24 - 1 mesh instances. Cost: one picture.
class Picker {
 public:
  explicit Picker(gpu::Device& device) : renderer_(device, 1) {}

  std::optional<std::size_t> pick(const scene_render::SceneModel& model, const scene_render::Camera& camera,
                                  std::uint32_t width, std::uint32_t height, std::uint32_t x,
                                  std::uint32_t y);

 private:
  scene_render::SceneRenderer renderer_;
};

}  // namespace scene_analyzer::viewer
