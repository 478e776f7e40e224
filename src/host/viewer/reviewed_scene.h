// reviewed_scene.h — The scene that is looked at: analyses, ratings, and what is drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "ratings/ratings.h"
#include "report/report.h"
#include "scene_render/scene_model_builder.h"
#include "viewer/review_job.h"

namespace scene_analyzer::viewer {

class ReviewedScene {
 public:
  explicit ReviewedScene(gpu::Device& device) : builder_(device) {}

  // What came of some assets.
  struct Arrived {
    bool all_good = true;               // no asset failed
    std::vector<std::string> messages;  // for the log, at warning level
  };
  // Appends them and rates the scene anew, by all metrics. Rows of the rating stay where they are, new ones
  // follow. Throws gpu::DeviceLost.
  Arrived add(const std::vector<ReviewJob::Finished>& assets);

  // Whether there is something to look at.
  bool is_ready() const { return rating_.bounds.has_value(); }

  void rate(const ratings::Options& options);
  const ratings::SceneRating& rating() const { return rating_; }
  const std::vector<analysis::AssetAnalysis>& assets() const { return assets_; }
  const scene_render::SceneModel& model() const { return model_; }
  const analysis::MetricSet& computed() const { return computed_; }  // metrics that some mesh has

  // Of a row of the rating.
  const analysis::InstanceAnalysis& instance(std::size_t row) const;
  const analysis::GeometryAnalysis& geometry(std::size_t row) const;
  std::string name(std::size_t row) const;

  report::SceneReport report() const;  // valid until the next rate()

 private:
  void append(const ReviewJob::Finished& asset);
  void note_computed();

  scene_render::SceneModelBuilder builder_;
  scene_render::SceneModel model_;
  std::vector<analysis::AssetAnalysis> assets_;
  analysis::MetricSet computed_;
  ratings::Options options_;
  ratings::SceneRating rating_;
};

}  // namespace scene_analyzer::viewer
