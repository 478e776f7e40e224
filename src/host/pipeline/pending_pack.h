// pending_pack.h — Assets whose meshes are measured together.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "analysis/analysis.h"
#include "pipeline/joined_scene.h"
#include "pipeline/pending_analysis.h"
#include "pipeline/scene_timing.h"

namespace scene_analyzer::pipeline {

class PendingPack {
 public:
  explicit PendingPack(std::vector<std::unique_ptr<PendingAnalysis>> assets) : assets_(std::move(assets)) {}

  // Its parts refer to each other.
  PendingPack(const PendingPack&) = delete;
  PendingPack& operator=(const PendingPack&) = delete;

  // Whether Pipeline::finish_pack would have to wait for a start triangle.
  bool is_searching() const;
  std::size_t size() const { return assets_.size(); }

 private:
  friend class Pipeline;
  // Assets that have something to measure; the others only wait to be finished.
  std::vector<PendingAnalysis*> measured() const;
  void report(double fraction, const std::string& step) const;

  const std::vector<std::unique_ptr<PendingAnalysis>> assets_;
  // Of two and more that are measured.
  std::vector<PendingAnalysis*> joined_assets_;
  JoinedScene joined_;
  analysis::AssetAnalysis analysis_;
  analysis::DeviceStamp device_;
  DegenerateTriangles degenerate_;
  std::unique_ptr<PendingMeasurement> measurement_;  // last: it uses the others to its end
};

}  // namespace scene_analyzer::pipeline
