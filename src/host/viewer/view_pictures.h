// view_pictures.h — What the window shows of the scene, and the same as a picture file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene_render/scene_renderer.h"
#include "viewer/review_state.h"
#include "viewer/reviewed_scene.h"

namespace scene_analyzer::viewer {

// Per mesh instance: as chosen, the selected one in full with its edges.
std::vector<scene_render::Look> looks_of(const ReviewState& state, const ratings::SceneRating& rating);

// The camera moved aside, so that its target is in the middle of what a panel at the left leaves free.
// `share`: of the width that the panel takes.
scene_render::Camera beside_panel(scene_render::Camera camera, double share, std::uint32_t width,
                                  std::uint32_t height);

// The bytes of a PNG file of `width` x `height` pixels: the scene, and below it what its colours mean. Throws
// as SceneRenderer::draw and pictures::compose do.
std::string picture_of_scene(scene_render::SceneRenderer& renderer, const ReviewedScene& scene,
                             const ReviewState& state, const scene_render::Camera& camera,
                             std::uint32_t width, std::uint32_t height);

// The bytes of a PNG file of what was rendered to `target`; throws the same.
std::string picture_of_window(gpu::Device& device, const gpu::RenderTarget& target);

}  // namespace scene_analyzer::viewer
