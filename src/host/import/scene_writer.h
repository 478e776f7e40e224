// scene_writer.h — Assimp's scene -> the worker's answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "import/asset_files.h"
#include "import/import.h"
#include "import/wire.h"

struct aiScene;

namespace scene_analyzer::import {

// Writes the record of scene_wire.h and finishes it. The scene's vertex arrays are freed as they are written.
// Materials from `file_materials` on are Assimp's, not the file's, and have no colour. Textures are looked up
// through `files`, and what is missing or refused becomes a warning. Cost: linear; beside the scene itself a
// few KiB, and what texture_writer.h says where textures are decoded.
void write_scene(aiScene& scene, std::size_t file_materials, AssetFiles& files,
                 std::vector<std::string> warnings, Textures textures, wire::Writer& writer);

// Triangles, over all meshes, that the scene holds (polygons as they will be cut).
std::uint64_t count_triangles(const aiScene& scene);

}  // namespace scene_analyzer::import
