// pending_analysis.h — An asset that was started and is not finished.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/scene.h"
#include "pipeline/pending_measurement.h"
#include "pipeline/pipeline.h"
#include "pipeline/scene_timing.h"

namespace scene_analyzer::pipeline {

// Of an asset's progress: where it is in memory,
inline constexpr double kImportEnds = 0.2;
// where rendering times begin, and where they, or without them the measuring, end.
inline constexpr double kTimingBegins = 0.4;
inline constexpr double kTimingEnds = 0.95;

class PendingAnalysis {
 public:
  // Whether Pipeline::finish would have to wait for a start triangle.
  bool is_searching() const { return measurement_ && measurement_->is_searching(); }
  // Whether the asset could not be read or measured: Pipeline::finish will say why.
  bool has_failed() const { return !outcome_.error.empty(); }
  // Whether it was imported and has meshes; else Pipeline::finish is all that is left to do.
  bool has_something_to_measure() const { return computed_ && !has_failed() && !scene_.instances.empty(); }

  const mesh::AssetSource& asset() const { return asset_; }
  // Of memory, about: the scene and the analysis.
  std::uint64_t held_bytes() const;
  std::uint64_t triangles() const;

  // Its parts refer to each other.
  PendingAnalysis(const PendingAnalysis&) = delete;
  PendingAnalysis& operator=(const PendingAnalysis&) = delete;

 private:
  friend class Pipeline;
  friend class PendingPack;
  PendingAnalysis(mesh::AssetSource asset, Progress report, std::shared_ptr<const Options> options);
  // The search for start triangles may end before or after rendering is timed: progress never falls.
  void report(double fraction, const std::string& step) {
    done_ = std::max(done_, fraction);
    if (progress_) progress_(done_, step);
  }

  const mesh::AssetSource asset_;
  const Progress progress_;
  const std::shared_ptr<const Options> options_;
  const std::shared_ptr<AnalysisStore> store_;  // or none
  double done_ = 0;
  Outcome outcome_;
  mesh::Scene scene_;
  analysis::MetricSet wanted_;
  bool computed_ = false;  // not read from the analysis file
  bool unchanged_ = true;  // while it was read
  DegenerateTriangles degenerate_;
  std::vector<analysis::RenderTiming> stored_timings_;   // from the analysis file,
  std::vector<analysis::FileFingerprint> stored_files_;  // which was made of these
  std::unique_ptr<PendingMeasurement> measurement_;      // last: it uses scene and outcome to its end
};

}  // namespace scene_analyzer::pipeline
