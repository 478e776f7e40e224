// panels.h — What stands beside the scene: the metrics, the meshes, the selected one, the state of things.
#pragma once

#include <string>
#include <vector>

#include "viewer/review_job.h"
#include "viewer/review_state.h"
#include "viewer/reviewed_scene.h"

namespace scene_analyzer::viewer {

struct Status {
  ReviewJob::Progress job;
  bool analysing = true;
  std::vector<std::string> messages;  // the newest last
  double frame_milliseconds = 0;
  bool edges_can_be_drawn = true, groups_can_be_drawn = true;
};

// To be called between InterfaceRenderer::begin_frame() and record(). Keeps the order of the table.
class Panels {
 public:
  // Changes `state` as the person does. True: the selected mesh is to be shown.
  bool draw(const ReviewedScene& scene, ReviewState& state, const Status& status);

  // Of the window's width, at its left.
  double share() const { return share_; }

 private:
  void draw_metrics(const ReviewedScene& scene, ReviewState& state, const Status& status);
  bool draw_table(const ReviewedScene& scene, ReviewState& state);
  void sort_rows(const ReviewedScene& scene);

  std::vector<std::size_t> rows_;  // of the rating, as the table shows them
  int sorted_by_ = 0;              // column
  bool ascending_ = true;
  double share_ = 0.25;
};

}  // namespace scene_analyzer::viewer
