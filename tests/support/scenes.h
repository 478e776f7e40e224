// scenes.h — Test meshes as a mesh::Scene, one instance each, and as a geometry::Batch.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mesh/scene.h"
#include "support/meshes.h"

namespace scene_analyzer::test {

// The scene owns the meshes. Instance i shows mesh i, untransformed.
inline mesh::Scene scene_of(std::vector<test_meshes::TestMesh> meshes) {
  auto owned = std::make_shared<std::vector<test_meshes::TestMesh>>(std::move(meshes));
  mesh::Scene scene;
  scene.asset = "test";
  for (const test_meshes::TestMesh& mesh : *owned) {
    scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()), .node = mesh.name});
    mesh::TriangleMesh added;
    added.name = mesh.name;
    added.positions = mesh.positions;
    added.indices = mesh.indices;
    scene.meshes.push_back(std::move(added));
  }
  scene.storage = owned;
  return scene;
}

}  // namespace scene_analyzer::test
