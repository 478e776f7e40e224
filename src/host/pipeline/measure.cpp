#include "pipeline/measure.h"

#include <cstdint>
#include <utility>

#include "gpu/error.h"
#include "pipeline/batch_run.h"
#include "pipeline/batching.h"
#include "pipeline/geometry_table.h"
#include "pipeline/stages.h"

namespace scene_analyzer::pipeline {

using analysis::GeometryAnalysis;

Measurer::Measurer(gpu::Device& device, const spectrum::SpectrumLimits& limits)
    : stages_(std::make_unique<Stages>(device, limits)) {}
Measurer::~Measurer() = default;

void Measurer::measure_batch(const PlannedBatch& plan, const Measurement& measurement,
                             const std::function<void(double, const char*)>& step) {
  try {
    BatchRun(*stages_, plan, measurement, step).run();
  } catch (const gpu::OutOfMemory& error) {
    // The estimate was too low: meshes with many shared edges need more. Halves get the device for
    // themselves, down to single meshes; one that still does not fit is reported, and the others keep their
    // results.
    if (plan.geometries.size() == 1) {
      analysis::AssetAnalysis& analysis = measurement.analysis;
      GeometryAnalysis& geometry = analysis.geometries[plan.geometries.front()];
      GeometryAnalysis untouched;
      untouched.mesh = geometry.mesh;
      untouched.linear = geometry.linear;
      untouched.source_triangles = geometry.source_triangles;
      untouched.not_analysed = error.what();
      geometry = std::move(untouched);
      for (analysis::InstanceAnalysis& instance : analysis.instances)
        if (instance.geometry == plan.geometries.front()) instance.bounds = std::nullopt;
      return;
    }
    const auto middle = static_cast<std::ptrdiff_t>(plan.geometries.size() / 2);
    const auto& meshes = plan.batch.meshes;
    const auto& geometries = plan.geometries;
    const PlannedBatch halves[] = {
        {.batch = {.meshes = {meshes.begin(), meshes.begin() + middle},
                   .transformed = plan.batch.transformed},
         .geometries = {geometries.begin(), geometries.begin() + middle}},
        {.batch = {.meshes = {meshes.begin() + middle, meshes.end()}, .transformed = plan.batch.transformed},
         .geometries = {geometries.begin() + middle, geometries.end()}}};
    for (const PlannedBatch& half : halves) measure_batch(half, measurement, step);
  }
}

void Measurer::measure(const mesh::Scene& scene, const analysis::Parameters& parameters,
                       analysis::MetricSet metrics, const Progress& progress,
                       analysis::AssetAnalysis& analysis, const HistogramSink& histograms,
                       const SignalSink& signals) {
  GeometryTable table = make_geometry_table(scene);
  analysis.geometries = std::move(table.geometries);
  analysis.instances = std::move(table.instances);
  const auto batches = plan_batches(scene, stages_->device.info(), analysis.geometries);
  const Measurement measurement{.parameters = parameters,
                                .metrics = metrics,
                                .analysis = analysis,
                                .histograms = histograms,
                                .signals = signals};
  std::uint64_t all = 0, done = 0;
  for (const PlannedBatch& plan : batches) all += plan.batch.triangle_count();
  for (const PlannedBatch& plan : batches) {
    const std::uint64_t here = plan.batch.triangle_count();
    const auto report = [&](double fraction, const char* step) {
      const double measured = static_cast<double>(done) + fraction * static_cast<double>(here);
      if (progress) progress(measured / static_cast<double>(all), step);
    };
    measure_batch(plan, measurement, report);
    done += here;
  }
}

}  // namespace scene_analyzer::pipeline
