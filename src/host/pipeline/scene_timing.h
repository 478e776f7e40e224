// scene_timing.h — The rendering times of a scene's geometries.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "mesh/scene.h"
#include "render_timing/render_timer.h"

namespace scene_analyzer::pipeline {

// Degenerate triangles of the geometries that have some, which are not drawn.
using DegenerateTriangles = std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>;

// Draws every geometry of `analysis`, which has been measured, that has a triangle; the others' times are 0.
// Throws gpu::DeviceLost, and gpu::Error when the device cannot draw a picture of that size.
analysis::RenderTiming time_scene(const render_timing::RenderTimer& timer, const mesh::Scene& scene,
                                  const analysis::AssetAnalysis& analysis,
                                  const DegenerateTriangles& degenerate,
                                  const analysis::RenderTiming::Conditions& conditions, double budget_seconds,
                                  const std::function<void(double fraction)>& progress);

// Whether it was made under `conditions`. A device without a name stands for any.
bool is_under(const analysis::RenderTiming& timing, const analysis::RenderTiming::Conditions& conditions);

// The first timing made under `conditions` that a budget of so many seconds would not better: it had as much,
// or stopped earlier because it was sure of all times. Null when there is none.
const analysis::RenderTiming* find_timing(const std::vector<analysis::RenderTiming>& timings,
                                          const analysis::RenderTiming::Conditions& conditions,
                                          double budget_seconds);

// Puts `timing` first, in place of one under the same conditions.
void put_first(std::vector<analysis::RenderTiming>& timings, analysis::RenderTiming timing);

// Whether something could not be measured.
bool is_incomplete(const analysis::RenderTiming& timing);

}  // namespace scene_analyzer::pipeline
