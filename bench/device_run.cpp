#include "device_run.h"

#include <algorithm>

namespace scene_analyzer::bench {

struct DeviceRun::Recording {
  gpu::Recorder recorder;
  double submitted = 0;  // seconds between submission and completion
  double host = 0;       // seconds that a stage spent elsewhere: results fetched, work on the host

  Recording(gpu::Device& device, bool profile) : recorder(device, profile) {}
  void submit() {
    submitted += elapsed_of([&] { recorder.submit_and_wait(); }).wall;
  }
};

DeviceRun::DeviceRun(const Kernels& kernels, const mesh::Scene& scene) : kernels_(kernels), scene_(scene) {
  for (const mesh::TriangleMesh& mesh : scene_.meshes) batch_.meshes.push_back({.mesh = &mesh});
}

Elapsed DeviceRun::run(Stage stage) {
  forget(stage);
  return elapsed_of([&] {
    Recording recording(kernels_.device, false);
    execute(stage, recording);
  });
}

Profile DeviceRun::profile(Stage stage) {
  forget(stage);
  Profile profile{.stage = stage, .parts = {}};
  Recording recording(kernels_.device, true);
  const double all = elapsed_of([&] { execute(stage, recording); }).wall;
  double in_kernels = 0;
  for (const gpu::Recorder::Timing& timing : recording.recorder.timings()) {
    const double seconds = timing.nanoseconds.value_or(0) * 1e-9;
    in_kernels += seconds;
    const auto known = std::find_if(profile.parts.begin(), profile.parts.end(),
                                    [&](const auto& part) { return part.first == timing.kernel; });
    if (known == profile.parts.end())
      profile.parts.emplace_back(timing.kernel, seconds);
    else
      known->second += seconds;
  }
  profile.parts.emplace_back("(between kernels: fills, copies, barriers)", recording.submitted - in_kernels);
  profile.parts.emplace_back("(before: buffers, upload, recording)",
                             all - recording.submitted - recording.host);
  profile.parts.emplace_back("(after: results, components, class limit)", recording.host);
  return profile;
}

// Frees what the stage is about to make, so that it is not there twice.
void DeviceRun::forget(Stage stage) {
  switch (stage) {
    case Stage::kGeometry:
      geometry_ = {};
      break;
    case Stage::kAdjacency:
      adjacency_ = {};
      break;
    case Stage::kPlanarGroups:
      groups_ = {};
      break;
    case Stage::kAreaClasses:
      classes_ = {};
      break;
    case Stage::kContrast:
      contrast_ = {};
      break;
  }
}

void DeviceRun::execute(Stage stage, Recording& recording) {
  gpu::Device& device = kernels_.device;
  const analysis::Parameters parameters;
  const auto after = [&](const auto& work) { recording.host += elapsed_of(work).wall; };
  switch (stage) {
    case Stage::kGeometry:
      geometry_ = kernels_.geometry.record(recording.recorder, batch_);
      recording.submit();
      after([&] { totals_ = geometry_.results(device); });
      break;
    case Stage::kAdjacency: {
      auto matching = kernels_.adjacency.record_matching(recording.recorder, geometry_);
      recording.submit();
      after([&] { adjacency_ = kernels_.adjacency.complete(device, geometry_, std::move(matching)); });
      break;
    }
    case Stage::kPlanarGroups:
      groups_ = kernels_.planar.record(recording.recorder, geometry_, adjacency_, parameters.alpha_degrees);
      recording.submit();
      break;
    case Stage::kAreaClasses:
      classes_ = kernels_.classes.record(recording.recorder, geometry_, totals_);
      recording.submit();
      after([&] { kernels_.classes.limit(device, classes_, parameters.dim); });
      break;
    case Stage::kContrast:
      contrast_ = kernels_.contrast.record(recording.recorder, geometry_, adjacency_, classes_);
      recording.submit();
      break;
  }
}

std::vector<analysis::GeometryAnalysis> DeviceRun::results() const {
  gpu::Device& device = kernels_.device;
  const auto topology = geometry_.chunks.results(device, adjacency_.totals);
  const auto planar = geometry_.chunks.results(device, groups_.totals);
  const auto contrast = geometry_.chunks.results(device, contrast_);
  std::vector<analysis::GeometryAnalysis> results(totals_.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    analysis::GeometryAnalysis& result = results[i];
    result.triangles = totals_[i].kept;
    result.degenerate_triangles = totals_[i].degenerate;
    result.source_triangles = result.triangles + result.degenerate_triangles;
    result.surface_area = totals_[i].area;
    result.components = topology[i].components;
    result.isolated_triangles = topology[i].isolated;
    result.boundary_edges = topology[i].boundary_edges;
    result.non_manifold_edges = topology[i].non_manifold_edges;
    result.planar_groups = planar[i].groups;
    result.largest_planar_group = planar[i].largest;
    result.area_classes = classes_.counts[i];
    const auto neighboured = static_cast<double>(result.triangles - topology[i].isolated);
    result.cooccurrence_contrast = neighboured == 0 ? 0 : contrast[i] / neighboured;
  }
  return results;
}

}  // namespace scene_analyzer::bench
