// reviewed_scene.h — The scene that is looked at: analyses, ratings, and what is drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "ratings/ratings.h"
#include "report/report.h"
#include "scene_render/scene_model.h"
#include "viewer/review_job.h"

namespace scene_analyzer::viewer {

class ReviewedScene {
 public:
  explicit ReviewedScene(gpu::Device& device) : builder_(device) {}

  // Appends one asset; it is drawn after finish(). Throws gpu::OutOfMemory.
  void add(const ReviewJob::Finished& asset);
  void finish();

  // Whether there is something to look at.
  bool is_ready() const { return model_ && rating_.bounds; }

  void rate(const ratings::Options& options);
  const ratings::SceneRating& rating() const { return rating_; }
  const std::vector<analysis::AssetAnalysis>& assets() const { return assets_; }
  const scene_render::SceneModel& model() const { return *model_; }
  analysis::MetricSet computed() const;  // metrics that some mesh has

  // Of a row of the rating.
  const analysis::InstanceAnalysis& instance(std::size_t row) const;
  const analysis::GeometryAnalysis& geometry(std::size_t row) const;
  std::string name(std::size_t row) const;

  report::SceneReport report() const;  // valid until the next rate()

 private:
  scene_render::SceneModelBuilder builder_;
  std::optional<scene_render::SceneModel> model_;
  std::vector<analysis::AssetAnalysis> assets_;
  ratings::Options options_;
  ratings::SceneRating rating_;
};

}  // namespace scene_analyzer::viewer
