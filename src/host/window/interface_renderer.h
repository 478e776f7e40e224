// interface_renderer.h — Dear ImGui on our own renderer: panels drawn over a scene, into the same picture.
#pragma once

#include <cstdint>
#include <memory>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "window/window.h"

namespace scene_analyzer::window {

// Owns the one ImGui context of the process. Between begin_frame() and record() ImGui's functions may be
// called.
class InterfaceRenderer {
 public:
  // `samples` per pixel of the targets. ImGui hears the window's mouse and keys, after Window itself.
  InterfaceRenderer(gpu::Device& device, const Window& window, std::uint32_t samples);
  ~InterfaceRenderer();
  InterfaceRenderer(const InterfaceRenderer&) = delete;
  InterfaceRenderer& operator=(const InterfaceRenderer&) = delete;

  void begin_frame();
  // Ends the frame and records its panels over what `target` holds; of the target's size. The renderer must
  // not begin another frame before the recording has run. Throws gpu::OutOfMemory.
  void record(gpu::Recorder& recorder, const gpu::RenderTarget& target);

 private:
  void grow(std::uint64_t vertices, std::uint64_t indices);

  gpu::Device& device_;
  gpu::RasterPipeline pipeline_;
  gpu::Texture font_;
  gpu::Buffer positions_, texture_positions_, colors_, indices_;
  std::uint64_t vertex_room_ = 0, index_room_ = 0;
};

}  // namespace scene_analyzer::window
