// twin_run.h — The same scene through the plain single-threaded twins of tests/reference.
#pragma once

#include <vector>

#include "analysis/analysis.h"
#include "mesh/scene.h"
#include "reference/evaluate.h"
#include "stages.h"

namespace scene_analyzer::bench {

class TwinRun {
 public:
  // `scene` must outlive the run.
  explicit TwinRun(const mesh::Scene& scene) : scene_(scene), meshes_(scene.meshes.size()) {}

  // What the stage took for all meshes. The results of the stages before must be there.
  Elapsed run(Stage stage);

  // All stages must have run.
  std::vector<analysis::GeometryAnalysis> results() const;

 private:
  static void execute(Stage stage, const mesh::TriangleMesh& mesh, reference::Evaluation& evaluation);

  const mesh::Scene& scene_;
  std::vector<reference::Evaluation> meshes_;
};

// All stages of all meshes one after the other, nothing kept but the results.
std::vector<analysis::GeometryAnalysis> measure_by_twin(const mesh::Scene& scene);

}  // namespace scene_analyzer::bench
