// gltf_nodes.h — Walks the node graph of a glTF file before Assimp does so by recursion.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace scene_analyzer::import {

// Which of the `meshes` meshes the default scene shows. Throws InputError (without the asset's name) for
// cycles, for numbers that do not exist, for a file without a scene, and for nodes shared so often that their
// tree would have more than ten million. A node with several parents, which glTF forbids and files have, is a
// warning: Assimp shows it under each. Cost: linear in nodes and children.
std::vector<bool> find_shown_meshes(const nlohmann::json& root, std::size_t meshes,
                                    std::vector<std::string>& warnings);

}  // namespace scene_analyzer::import
