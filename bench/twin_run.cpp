#include "twin_run.h"

namespace scene_analyzer::bench {

Elapsed TwinRun::run(Stage stage) {
  return elapsed_of([&] {
    for (std::size_t i = 0; i < meshes_.size(); ++i) execute(stage, scene_.meshes[i], meshes_[i]);
  });
}

void TwinRun::execute(Stage stage, const mesh::TriangleMesh& mesh, reference::Evaluation& evaluation) {
  const analysis::Parameters parameters;
  const auto geometry = [&] {
    return reference::Geometry{mesh.positions, mesh.indices, evaluation.representative};
  };
  switch (stage) {
    case Stage::kGeometry:
      evaluation.representative = reference::weld(mesh.positions);
      evaluation.triangles = reference::measure_triangles(geometry());
      break;
    case Stage::kAdjacency:
      evaluation.adjacency = reference::find_adjacency(geometry(), evaluation.triangles.kept);
      break;
    case Stage::kPlanarGroups:
      evaluation.groups = reference::planar_groups(geometry(), evaluation.triangles, evaluation.adjacency,
                                                   parameters.alpha_degrees);
      break;
    case Stage::kAreaClasses:
      evaluation.classes =
          reference::area_classes(evaluation.triangles.area, evaluation.triangles.kept, parameters.dim);
      break;
    case Stage::kContrast:
      evaluation.contrast = reference::cooccurrence_contrast(evaluation.adjacency, evaluation.classes);
      break;
  }
}

std::vector<analysis::GeometryAnalysis> TwinRun::results() const {
  std::vector<analysis::GeometryAnalysis> results;
  for (const reference::Evaluation& evaluation : meshes_) results.push_back(reference::summarize(evaluation));
  return results;
}

std::vector<analysis::GeometryAnalysis> measure_by_twin(const mesh::Scene& scene) {
  std::vector<analysis::GeometryAnalysis> results;
  for (const mesh::TriangleMesh& mesh : scene.meshes)
    results.push_back(reference::evaluate(mesh.positions, mesh.indices));
  return results;
}

}  // namespace scene_analyzer::bench
