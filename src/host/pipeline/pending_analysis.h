// pending_analysis.h — An asset that was started and is not finished.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "mesh/scene.h"
#include "pipeline/pending_measurement.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::pipeline {

class PendingAnalysis {
 public:
  // Whether Pipeline::finish would have to wait for a start triangle.
  bool is_searching() const { return measurement_ && measurement_->is_searching(); }

 private:
  friend class Pipeline;
  PendingAnalysis(std::filesystem::path asset, Progress report)
      : asset_(std::move(asset)), report_(std::move(report)) {}

  const std::filesystem::path asset_;
  const Progress report_;
  Outcome outcome_;
  mesh::Scene scene_;
  bool computed_ = false;                            // not read from the analysis file
  bool unchanged_ = true;                            // while it was read
  std::unique_ptr<PendingMeasurement> measurement_;  // last: it uses scene and outcome to its end
};

}  // namespace scene_analyzer::pipeline
