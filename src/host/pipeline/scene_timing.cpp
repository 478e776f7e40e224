#include "pipeline/scene_timing.h"

#include <algorithm>
#include <utility>

namespace scene_analyzer::pipeline {

using analysis::RenderTiming;

RenderTiming time_scene(const render_timing::RenderTimer& timer, const mesh::Scene& scene,
                        const analysis::AssetAnalysis& analysis, const DegenerateTriangles& degenerate,
                        const RenderTiming::Conditions& conditions, double budget_seconds,
                        const std::function<void(double fraction)>& progress) {
  std::vector<render_timing::TimedMesh> meshes;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < analysis.geometries.size(); ++i) {
    const analysis::GeometryAnalysis& geometry = analysis.geometries[i];
    if (geometry.triangles == 0 || !geometry.not_analysed.empty()) continue;
    const mesh::TriangleMesh& mesh = scene.meshes.at(geometry.mesh);
    const auto left_out = degenerate.find(static_cast<std::uint32_t>(i));
    meshes.push_back(
        {.positions = mesh.positions, .indices = mesh.indices, .left_out = {}, .linear = geometry.linear});
    if (left_out != degenerate.end()) meshes.back().left_out = left_out->second;
    owners.push_back(i);
  }
  RenderTiming timing;
  timing.conditions = conditions;
  timing.times.resize(analysis.geometries.size());
  const auto times = timer.measure(meshes, {.width = conditions.width,
                                            .height = conditions.height,
                                            .steps = conditions.steps,
                                            .budget_seconds = budget_seconds,
                                            .progress = progress});
  for (std::size_t i = 0; i < owners.size(); ++i) timing.times[owners[i]] = times[i];
  return timing;
}

bool is_under(const RenderTiming& timing, const RenderTiming::Conditions& conditions) {
  RenderTiming::Conditions wanted = conditions;
  if (wanted.device.name.empty()) wanted.device = timing.conditions.device;
  return timing.conditions == wanted;
}

const RenderTiming* find_timing(const std::vector<RenderTiming>& timings,
                                const RenderTiming::Conditions& conditions, double budget_seconds) {
  const double precision = render_timing::TimingOptions().precision;
  const auto is_sure = [&](const analysis::RenderingTime& time) {
    return time.mean_ns == 0 || (time.rotations == conditions.steps * conditions.steps &&
                                 time.confidence_ns && *time.confidence_ns <= precision * time.mean_ns);
  };
  const auto found = std::ranges::find_if(timings, [&](const RenderTiming& timing) {
    return is_under(timing, conditions) &&
           (timing.budget_seconds >= budget_seconds || std::ranges::all_of(timing.times, is_sure));
  });
  return found == timings.end() ? nullptr : &*found;
}

void put_first(std::vector<RenderTiming>& timings, RenderTiming timing) {
  std::erase_if(timings, [&](const RenderTiming& other) { return other.conditions == timing.conditions; });
  timings.insert(timings.begin(), std::move(timing));
}

bool is_incomplete(const RenderTiming& timing) {
  return std::ranges::any_of(timing.times, [](const auto& time) { return !time.not_measured.empty(); });
}

}  // namespace scene_analyzer::pipeline
