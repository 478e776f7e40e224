#include "pipeline/pending_measurement.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "gpu/error.h"
#include "pipeline/geometry_table.h"

namespace scene_analyzer::pipeline {
namespace {

using analysis::GeometryAnalysis;

PlannedBatch part_of(const PlannedBatch& plan, std::size_t begin, std::size_t end) {
  const auto part = [&](const auto& all) {
    return std::vector(all.begin() + static_cast<std::ptrdiff_t>(begin),
                       all.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {.batch = {.meshes = part(plan.batch.meshes), .transformed = plan.batch.transformed},
          .geometries = part(plan.geometries)};
}

}  // namespace

PendingMeasurement::PendingMeasurement(Measurer::Stages& stages, Measurement measurement)
    : stages_(stages), measurement_(std::move(measurement)) {
  analysis::AssetAnalysis& analysis = measurement_.analysis;
  GeometryTable table = make_geometry_table(measurement_.scene);
  analysis.geometries = std::move(table.geometries);
  analysis.instances = std::move(table.instances);
  auto batches = plan_batches(measurement_.scene, stages.device.info(), analysis.geometries);
  std::uint64_t all = 0;
  for (const PlannedBatch& plan : batches) all += plan.batch.triangle_count();
  for (PlannedBatch& plan : batches) {
    const double part = static_cast<double>(plan.batch.triangle_count()) / static_cast<double>(all);
    run(std::move(plan), {.whole = part});
    finish_all_but(1);
  }
}

bool PendingMeasurement::is_searching() const {
  return std::ranges::any_of(pending_, [](const auto& batch) { return batch->is_searching(); });
}

void PendingMeasurement::finish() {
  finish_all_but(0);
}

void PendingMeasurement::finish_all_but(std::size_t count) {
  while (pending_.size() > count) {
    pending_.front()->finish();
    pending_.pop_front();
  }
}

void PendingMeasurement::run(PlannedBatch plan, Share share) {
  const auto counted = std::make_shared<Share>(share);
  auto batch = std::make_unique<BatchRun>(
      stages_, std::move(plan), measurement_,
      [this, counted](double fraction, const char* step) { report(*counted, fraction, step); });
  try {
    batch->run_on_device();
  } catch (const gpu::OutOfMemory& error) {
    // The estimate was too low: meshes with many shared edges need more. Halves get the device for
    // themselves, down to single meshes; one that still does not fit is reported, and the others keep their
    // results.
    const PlannedBatch failed = batch->plan();
    batch.reset();
    if (failed.geometries.size() > 1) return run_halves(failed, *counted);
    refuse(failed.geometries.front(), error.what());
    return report(*counted, 1, "results");
  }
  pending_.push_back(std::move(batch));
}

void PendingMeasurement::run_halves(const PlannedBatch& plan, const Share& share) {
  const std::size_t count = plan.geometries.size();
  const Share half{.whole = (share.whole - share.done) / 2};
  run(part_of(plan, 0, count / 2), half);
  finish_all_but(1);
  run(part_of(plan, count / 2, count), half);
}

void PendingMeasurement::report(Share& share, double fraction, const char* step) {
  const double fresh = std::max(0.0, fraction * share.whole - share.done);
  share.done += fresh;
  done_ += fresh;
  if (measurement_.progress) measurement_.progress(std::min(done_, 1.0), step);
}

void PendingMeasurement::refuse(std::uint32_t index, const char* reason) {
  analysis::AssetAnalysis& analysis = measurement_.analysis;
  GeometryAnalysis& geometry = analysis.geometries[index];
  GeometryAnalysis untouched;
  untouched.mesh = geometry.mesh;
  untouched.linear = geometry.linear;
  untouched.shape_hash = geometry.shape_hash;
  untouched.source_triangles = geometry.source_triangles;
  untouched.not_analysed = reason;
  geometry = std::move(untouched);
  for (analysis::InstanceAnalysis& instance : analysis.instances)
    if (instance.geometry == index) instance.bounds = std::nullopt;
}

}  // namespace scene_analyzer::pipeline
