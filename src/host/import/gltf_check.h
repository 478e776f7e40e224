// gltf_check.h — What Assimp gets silently wrong in glTF 2.0, found before it can.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "import/asset_files.h"

struct aiScene;

namespace scene_analyzer::import {

struct ExpectedGltf {
  std::optional<std::uint64_t>
      triangles;  // over all meshes that the scene's nodes show, each once; absent: no glTF 2
  // Materials of the file; what Assimp has beyond is its default.
  std::size_t materials = std::numeric_limits<std::size_t>::max();
  // What Assimp has to read in place of the file, or empty: skins without matrices, which are valid, crash
  // it (the rest pose needs no skin), and a byte order mark hides the format from it.
  std::string replacement;
};

// Whether a required extension is on the list of those under which Assimp's geometry was tested to be right.
bool is_tested_extension(const std::string& name);

// Throws InputError (without the asset's name) for required extensions that are not on the tested list, data
// beyond buffers, vertex numbers beyond vertices, positions that are not three floats, unknown primitive
// modes, and nodes that do not form a tree. Other formats pass. Cost: one pass over JSON and over the vertex
// numbers.
ExpectedGltf check_gltf(AssetFiles& files, std::vector<std::string>& warnings);

// Throws InputError when Assimp's scene has not the triangles that the file promises.
void require_expected(const ExpectedGltf& expected, const aiScene& scene);

}  // namespace scene_analyzer::import
