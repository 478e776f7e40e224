#include "subject.h"

#include <algorithm>
#include <stdexcept>

#include "comparison.h"
#include "support/scenes.h"

namespace scene_analyzer::bench {
namespace {

void require_equal(const Case& which, const std::vector<analysis::GeometryAnalysis>& device,
                   const std::vector<analysis::GeometryAnalysis>& twin, bool ratings) {
  if (const auto difference = first_difference(device, twin, ratings))
    throw std::runtime_error(which.name + ": " + *difference);
}

}  // namespace

Subject::Subject(Bench& bench, const Case& of) : bench_(bench), case_(of), scene_(test::scene_of(of.make())) {
  for (const mesh::TriangleMesh& mesh : scene_.meshes) triangles_ += mesh.triangle_count();
  const std::uint64_t before = bench_.device.buffer_bytes();
  bench_.device.reset_peak();
  const auto device = measure();
  peak_bytes_ = bench_.device.peak_buffer_bytes() - before;
  require_equal(case_, device, measure_by_twin(scene_), true);
}

std::vector<analysis::GeometryAnalysis> Subject::measure() {
  analysis::AssetAnalysis analysis;
  // Start triangles would hide everything else, and the twin's take all pairs.
  const auto stages =
      analysis::MetricSet().set().reset(analysis::index_of(analysis::Metric::kFourierTransform));
  bench_.measurer.measure({.scene = scene_, .analysis = analysis, .metrics = stages});
  return std::move(analysis.geometries);
}

Subject::Runs& Subject::runs() {
  if (runs_) return *runs_;
  runs_.reset(new Runs{.device = {bench_.kernels, scene_}, .twin = TwinRun(scene_)});
  for (std::size_t stage = 0; stage < kStageCount; ++stage) {
    runs_->device.run(static_cast<Stage>(stage));
    runs_->twin.run(static_cast<Stage>(stage));
  }
  require_equal(case_, runs_->device.results(), runs_->twin.results(), false);
  return *runs_;
}

Round Subject::time_whole() {
  runs_.reset();  // the recipe shall have the memory for itself
  Round round;
  round.device = elapsed_of([&] { measure(); });
  round.twin = elapsed_of([&] { measure_by_twin(scene_); });
  return round;
}

Round Subject::time_stage(Stage stage) {
  Runs& both = runs();
  return {.device = both.device.run(stage), .twin = both.twin.run(stage)};
}

Profile Subject::profile(Stage stage) {
  Profile least = runs().device.profile(stage);
  for (int again = 0; again < 2; ++again) {
    const Profile next = runs().device.profile(stage);
    for (std::size_t part = 0; part < least.parts.size(); ++part)
      least.parts[part].second = std::min(least.parts[part].second, next.parts[part].second);
  }
  return least;
}

}  // namespace scene_analyzer::bench
