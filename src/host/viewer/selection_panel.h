// selection_panel.h — What is known of the selected mesh: numbers, ratings, its signal.
#pragma once

#include <cstddef>
#include <optional>

#include "scene_render/camera.h"
#include "viewer/reviewed_scene.h"
#include "viewer/signal_job.h"

namespace scene_analyzer::viewer {

// A panel at the right edge, and brackets around the mesh in the scene. `signal` is about another mesh until
// its job has heard of the selection.
void draw_selected(const ReviewedScene& scene, std::size_t row, const SignalJob::State& signal,
                   const scene_render::Camera& camera);

// The signal that the row's Fourier rating comes from; nothing where there is none.
std::optional<SignalJob::Wanted> signal_of(const ReviewedScene& scene, std::size_t row);

}  // namespace scene_analyzer::viewer
