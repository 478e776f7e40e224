// gltf_document.h — A glTF 2.0 file as JSON and buffers, read independently of Assimp so that Assimp can be
// checked.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "import/asset_files.h"
#include "import/mapped_file.h"

namespace scene_analyzer::import {

struct GltfDocument {
  nlohmann::json root;
  std::vector<std::span<const std::uint8_t>> buffers;  // exactly byteLength bytes each

  std::optional<std::span<const std::uint8_t>> binary_chunk;  // of a GLB
  // The file's text behind a byte order mark, which JSON does not have, files do and Assimp trips over; else
  // empty.
  std::string_view behind_mark;
  std::vector<MappedFile> files;  // what the spans point into
  std::vector<std::vector<std::uint8_t>> decoded;
};

// Container and JSON. Nothing for other formats and for glTF 1. Throws InputError (without the asset's name)
// when they are broken.
std::optional<GltfDocument> open_gltf(const AssetFiles& files, std::vector<std::string>& warnings);

// Fills `buffers`. Throws InputError for a buffer that is missing, out of the asset's folder, or shorter than
// it says. Cost: data URIs are decoded; buffers in files are mapped, not read.
void load_buffers(GltfDocument& document, AssetFiles& files);

// The file again, in the container it came in, with no node using a skin.
std::string without_skins(const GltfDocument& document);

// Members of JSON objects. `where` names the object in messages ("accessor 3"). Throw InputError for the
// wrong type.
std::uint64_t whole_number(const nlohmann::json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where);
std::uint64_t whole_number(const nlohmann::json& object, const char* key,
                           const std::string& where);  // required
// The array, or an empty one when absent.
const nlohmann::json& array_of(const nlohmann::json& object, const char* key, const std::string& where);

}  // namespace scene_analyzer::import
