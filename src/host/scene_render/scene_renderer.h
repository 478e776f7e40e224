// scene_renderer.h — Draws a scene in colours: for pictures, offscreen, and for the window.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/scene_render.h"
#include "ratings/ratings.h"
#include "scene_render/camera.h"
#include "scene_render/look.h"
#include "scene_render/picture.h"
#include "scene_render/scene_model.h"

namespace scene_analyzer::scene_render {

inline constexpr std::array<float, 4> kBackground = {1, 1, 1, 1};

class SceneRenderer {
 public:
  // `samples` per pixel, 1 or 4. Throws gpu::Error when the device cannot draw.
  SceneRenderer(gpu::Device& device, std::uint32_t samples);

  // Records the drawing of all instances over the background; `looks` run along them. Opaque ones first, then
  // the others from the farthest to the nearest. `model` must live until the recording has run.
  void record(gpu::Recorder& recorder, const gpu::RenderTarget& target, const SceneModel& model,
              const Camera& camera, std::span<const Look> looks) const;

  // The same into a picture of its own. Throws gpu::Error for a size beyond the device, gpu::OutOfMemory,
  // gpu::DeviceLost.
  Picture draw(const SceneModel& model, const Camera& camera, std::span<const Look> looks,
               std::uint32_t width, std::uint32_t height);

  // Colours of planar groups, from a triangle alone to the largest group.
  void set_group_colors(ratings::ColorMap map);
  bool can_draw_edges() const { return device_.info().draws_wireframes; }
  bool can_draw_groups() const { return device_.info().numbers_triangles; }

 private:
  struct Pipelines {
    gpu::RasterPipeline meshes, groups, edges;
  };
  Pipelines make_pipelines(bool translucent);
  void record_edges(gpu::Recorder& recorder, gpu::Recorder::Draw draw,
                    interface::scene_render::SceneDrawParams params, double pixels_per_triangle) const;
  void record_instance(gpu::Recorder& recorder, const SceneModel& model, std::size_t index, const Look& look,
                       const Camera& camera, const gpu::RenderTarget& target) const;

  gpu::Device& device_;
  std::uint32_t samples_;
  Pipelines opaque_, translucent_;
  gpu::Texture white_;
  gpu::Buffer no_attribute_;  // for meshes without normals or texture coordinates
  gpu::Array<std::uint32_t> group_colors_;
};

}  // namespace scene_analyzer::scene_render
