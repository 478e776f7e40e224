#include "import/warnings.h"

#include <assimp/scene.h>

#include <algorithm>
#include <filesystem>

namespace scene_analyzer::import {
namespace {

constexpr std::size_t kLongestList = 8;      // names
constexpr std::size_t kLongestListed = 200;  // bytes of a name in a list

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "es");
}

// "a, b and 3 more".
std::string cut_list(const std::vector<std::string>& items) {
  std::string list;
  for (std::size_t i = 0; i < std::min(items.size(), kLongestList); ++i)
    list += (i == 0 ? "" : ", ") + items[i];
  if (items.size() > kLongestList) list += " and " + std::to_string(items.size() - kLongestList) + " more";
  return list;
}

std::string quoted(const std::string& name) {
  return "\"" + name.substr(0, kLongestListed) + "\"";
}

}  // namespace

void warn_about_list(const std::vector<std::string>& names, const std::string& noun,
                     const std::string& singular, const std::string& plural,
                     std::vector<std::string>& warnings) {
  if (names.empty()) return;
  if (names.size() == 1) {
    warnings.push_back(noun + " \"" + names.front() + "\" " + singular);
    return;
  }
  std::vector<std::string> items;
  for (const std::string& name : names) items.push_back(quoted(name));
  warnings.push_back(std::to_string(names.size()) + " " + noun + "s " + plural + ": " + cut_list(items));
}

void warn_about_textures(const std::vector<UndecodedTexture>& textures, std::vector<std::string>& warnings) {
  if (textures.empty()) return;
  const auto name = [](const UndecodedTexture& texture) {
    return texture.name.empty() ? "without a name" : quoted(texture.name);
  };
  if (textures.size() == 1) {
    warnings.push_back("texture " + name(textures.front()) +
                       " cannot be decoded: " + textures.front().reason);
    return;
  }
  std::vector<std::string> items;
  for (const UndecodedTexture& texture : textures)
    items.push_back(name(texture) + " (" + texture.reason + ")");
  warnings.push_back(std::to_string(textures.size()) + " textures cannot be decoded: " + cut_list(items));
}

void warn_about_meshes(const aiScene& scene, std::span<const NodeMesh> instances,
                       std::vector<std::string>& warnings) {
  std::vector<bool> shown(scene.mNumMeshes, false);
  for (const NodeMesh& instance : instances)
    if (instance.mesh < shown.size()) shown[instance.mesh] = true;
  const auto hidden = static_cast<std::size_t>(std::count(shown.begin(), shown.end(), false));
  if (hidden > 0)
    warnings.push_back(counted(hidden, "mesh") + (hidden == 1 ? " is" : " are") +
                       " not placed by any node and not measured");
}

void warn_about_files(const AssetFiles& files, std::vector<std::string>& warnings) {
  std::vector<std::string> materials = files.missing_with_extension(".mtl");
  // Assimp tries the asset's own name when the one in the file is not there; nobody misses that.
  const std::string guess = std::filesystem::path(files.asset_name()).replace_extension(".mtl").string();
  if (materials.size() > 1) std::erase(materials, guess);
  warn_about_list(materials, "material file", "is missing", "are missing", warnings);
  warn_about_list({files.refused().begin(), files.refused().end()}, "reference",
                  "leads out of the asset's folder and was not followed",
                  "lead out of the asset's folder and were not followed", warnings);
}

}  // namespace scene_analyzer::import
