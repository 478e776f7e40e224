#include "viewer/picking.h"

#include <vector>

namespace scene_analyzer::viewer {
namespace {

// Of 8 bits per channel, and never the white of the background.
ratings::Rgb color_of(std::size_t number) {
  return {static_cast<double>(number & 255) / 255, static_cast<double>(number >> 8 & 255) / 255,
          static_cast<double>(number >> 16 & 255) / 255};
}

}  // namespace

std::optional<std::size_t> Picker::pick(const scene_render::SceneModel& model,
                                        const scene_render::Camera& camera, std::uint32_t width,
                                        std::uint32_t height, std::uint32_t x, std::uint32_t y) {
  if (x >= width || y >= height) return std::nullopt;
  std::vector<scene_render::Look> looks(model.size());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    looks[i].fill = scene_render::Look::Fill::kUnlitColor;
    looks[i].color = color_of(i);
  }
  const scene_render::Picture picture = renderer_.draw(model, camera, looks, width, height);
  const std::uint8_t* pixel = &picture.rgba[4 * (std::size_t{y} * width + x)];
  const std::size_t number = pixel[0] | std::size_t{pixel[1]} << 8 | std::size_t{pixel[2]} << 16;
  if (number >= model.size()) return std::nullopt;
  return number;
}

}  // namespace scene_analyzer::viewer
