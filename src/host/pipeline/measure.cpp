#include "pipeline/measure.h"

#include <utility>

#include "pipeline/pending_measurement.h"
#include "pipeline/stages.h"

namespace scene_analyzer::pipeline {

Measurer::Measurer(gpu::Device& device, const spectrum::SpectrumLimits& limits)
    : stages_(std::make_unique<Stages>(device, limits)) {}
Measurer::~Measurer() = default;

void Measurer::measure(Measurement measurement) {
  start(std::move(measurement))->finish();
}

std::unique_ptr<PendingMeasurement> Measurer::start(Measurement measurement) {
  return std::make_unique<PendingMeasurement>(*stages_, std::move(measurement));
}

}  // namespace scene_analyzer::pipeline
