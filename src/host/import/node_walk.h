// node_walk.h — Assimp's node tree -> mesh instances in the order of the tables.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/scene.h"

struct aiNode;
struct aiScene;

namespace scene_analyzer::import {

struct NodeMesh {
  const aiNode* node = nullptr;
  std::uint32_t mesh = 0;
  mesh::Matrix4 world = mesh::kIdentity4;
};

// Depth-first, a node's meshes before its children; world matrices are products in double. Without recursion:
// trees may be thousands of levels deep. Mesh numbers that do not exist are left to the reader, which refuses
// them.
std::vector<NodeMesh> walk_nodes(const aiScene& scene);

}  // namespace scene_analyzer::import
