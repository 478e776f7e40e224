#include "viewer/view_pictures.h"

#include <algorithm>

#include "pictures/compose.h"

namespace scene_analyzer::viewer {

std::vector<scene_render::Look> looks_of(const ReviewState& state, const ratings::SceneRating& rating) {
  std::vector<scene_render::Look> looks = pictures::looks(content_of(state), rating);
  for (scene_render::Look& look : looks) look.edges = state.wireframe;
  if (state.selected && *state.selected < looks.size()) {
    looks[*state.selected].edges = true;
    looks[*state.selected].opacity = 1;
  }
  return looks;
}

scene_render::Camera beside_panel(scene_render::Camera camera, double share, std::uint32_t width,
                                  std::uint32_t height) {
  camera.middle[0] = -camera.tangent * share * width / std::max(height, 1u);
  return camera;
}

std::string picture_of_scene(scene_render::SceneRenderer& renderer, const ReviewedScene& scene,
                             const ReviewState& state, const scene_render::Camera& camera,
                             std::uint32_t width, std::uint32_t height) {
  const std::uint32_t rows = height - pictures::legend_height(width, height);
  const scene_render::Picture view =
      renderer.draw(scene.model(), camera, looks_of(state, scene.rating()), width, rows);
  const auto legend = pictures::make_legend(content_of(state), scene.rating(), describe(state));
  return pictures::compose(view, {}, legend, height);
}

std::string picture_of_window(gpu::Device& device, const gpu::RenderTarget& target) {
  const scene_render::Picture picture = scene_render::read_picture(device, target);
  return pictures::compose(picture, {}, {}, picture.height);
}

}  // namespace scene_analyzer::viewer
