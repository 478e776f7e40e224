// picture.h — A picture in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/device.h"

namespace scene_analyzer::scene_render {

// RGBA, 4 bytes per pixel, rows from the top.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// What was rendered to `target`. Throws gpu::OutOfMemory, gpu::DeviceLost.
Picture read_picture(gpu::Device& device, const gpu::RenderTarget& target);

}  // namespace scene_analyzer::scene_render
