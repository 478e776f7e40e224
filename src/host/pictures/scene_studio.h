// scene_studio.h — Pictures of a rated scene, one after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "pictures/far_away.h"
#include "pictures/picture_content.h"
#include "ratings/ratings.h"
#include "scene_render/scene_model.h"
#include "scene_render/scene_renderer.h"

namespace scene_analyzer::pictures {

struct PictureFormat {
  std::uint32_t width = 1280, height = 720;  // pixels, the legend included
  std::optional<mesh::Vector3> target;       // world; default: see scene_render::make_camera
};

struct RatedScene {
  std::span<const analysis::AssetAnalysis> assets;
  const ratings::SceneRating& rating;
  const ratings::Options& options;  // that it was rated with
};

class SceneStudio {
 public:
  // What `scene` refers to must outlive the studio. Throws gpu::Error when the device cannot draw.
  SceneStudio(gpu::Device& device, const RatedScene& scene, const PictureFormat& format);

  bool can_draw_groups() const { return renderer_.can_draw_groups(); }

  // The assets of the scene, in their order (SceneLoader). Throws InputError when there is nothing to be
  // seen.
  void set_model(scene_render::SceneModel model);
  // A mesh that makes all others too small to be seen, where no target was chosen; name_of() tells its name.
  std::optional<FarAway> far_away() const;
  std::string name_of(std::size_t row) const;  // "mesh 3 (lamp)"

  // The bytes of a PNG file. Throws gpu::OutOfMemory, gpu::DeviceLost, gpu::Error for a size beyond the
  // device, std::bad_alloc, and what `look` does, which is called again and again while a large picture is
  // compressed.
  std::string draw(const Content& content, const std::function<void()>& look = {});

 private:
  void frame();
  const ratings::SceneRating& rating_of(const Content& content);
  bool has_unknown_groups() const;

  const RatedScene scene_;
  const PictureFormat format_;
  scene_render::SceneRenderer renderer_;
  std::optional<scene_render::SceneModel> model_;
  std::optional<analysis::Bounds> bounds_;
  std::optional<ratings::SceneRating> other_mode_;
};

}  // namespace scene_analyzer::pictures
