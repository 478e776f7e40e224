// stages.h — Short names for tests of the twins.
#pragma once

#include "reference/evaluate.h"
#include "support/meshes.h"

namespace scene_analyzer::reference {

inline analysis::GeometryAnalysis evaluate(const test_meshes::TestMesh& mesh,
                                           const analysis::Parameters& parameters = {}) {
  return evaluate(mesh.positions, mesh.indices, mesh::kIdentity3, parameters);
}
inline Evaluation evaluate_stages(const test_meshes::TestMesh& mesh,
                                  const analysis::Parameters& parameters = {}) {
  return evaluate_stages(mesh.positions, mesh.indices, mesh::kIdentity3, parameters);
}
inline Geometry geometry_of(const test_meshes::TestMesh& mesh, const Evaluation& stages) {
  return {mesh.positions, mesh.indices, stages.representative, mesh::kIdentity3};
}

}  // namespace scene_analyzer::reference
