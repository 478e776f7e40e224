#include "import/node_walk.h"

#include <assimp/scene.h>

#include <span>

namespace scene_analyzer::import {
namespace {

mesh::Matrix4 matrix_of(const aiNode& node) {
  const aiMatrix4x4& m = node.mTransformation;
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

mesh::Matrix4 multiply(const mesh::Matrix4& left, const mesh::Matrix4& right) {
  mesh::Matrix4 product{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      for (std::size_t k = 0; k < 4; ++k)
        product[row * 4 + column] += left[row * 4 + k] * right[k * 4 + column];
  return product;
}

struct Visit {
  const aiNode* node = nullptr;
  mesh::Matrix4 world;
};

}  // namespace

std::vector<NodeMesh> walk_nodes(const aiScene& scene) {
  std::vector<NodeMesh> instances;
  std::vector<Visit> waiting;
  if (scene.mRootNode != nullptr) waiting.push_back({scene.mRootNode, matrix_of(*scene.mRootNode)});
  while (!waiting.empty()) {
    const Visit visit = waiting.back();
    waiting.pop_back();
    for (const unsigned mesh : std::span(visit.node->mMeshes, visit.node->mNumMeshes))
      instances.push_back({visit.node, mesh, visit.world});
    // Last in, first out: the first child has to go in last.
    for (unsigned i = visit.node->mNumChildren; i-- > 0;) {
      const aiNode* child = visit.node->mChildren[i];
      waiting.push_back({child, multiply(visit.world, matrix_of(*child))});
    }
  }
  return instances;
}

}  // namespace scene_analyzer::import
