// warnings.h — Sentences about what an import leaves out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "import/asset_files.h"
#include "import/node_walk.h"

struct aiScene;

namespace scene_analyzer::import {

// "texture "a.png" is missing", "3 textures are missing: "a.png", "b.png", "c.png"", nothing for an empty
// list; long lists are cut with their number.
void warn_about_list(const std::vector<std::string>& names, const std::string& noun,
                     const std::string& singular, const std::string& plural,
                     std::vector<std::string>& warnings);

struct UndecodedTexture {
  std::string name;  // as the file names it; empty for an unnamed embedded one
  std::string reason;
};

// One sentence for all of them, each with its reason, cut like the list above.
void warn_about_textures(const std::vector<UndecodedTexture>& textures, std::vector<std::string>& warnings);

// Meshes that no node shows, and points and lines, which are not measured.
void warn_about_meshes(const aiScene& scene, std::span<const NodeMesh> instances,
                       std::vector<std::string>& warnings);

// Missing material libraries and references that lead out of the asset's folder.
void warn_about_files(const AssetFiles& files, std::vector<std::string>& warnings);

}  // namespace scene_analyzer::import
