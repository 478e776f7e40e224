#include "scene_render/picture.h"

#include <span>

#include "gpu/recorder.h"

namespace scene_analyzer::scene_render {

Picture read_picture(gpu::Device& device, const gpu::RenderTarget& target) {
  const gpu::Buffer pixels = device.make_vertex_buffer("pixels of a picture", target.color_bytes());
  gpu::Recorder recorder(device);
  recorder.copy_color(target, pixels);
  recorder.submit_and_wait();
  Picture picture{target.width(), target.height(), std::vector<std::uint8_t>(target.color_bytes())};
  device.download(pixels, 0, std::as_writable_bytes(std::span(picture.rgba)));
  return picture;
}

}  // namespace scene_analyzer::scene_render
