// appearance.h — Materials, textures, and what the file says about units and axes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "import/asset_files.h"
#include "import/wire.h"
#include "mesh/scene.h"

struct aiScene;

namespace scene_analyzer::import {

struct Conventions {
  std::optional<double> unit_scale;    // metres per unit
  std::optional<std::string> up_axis;  // "+Y"
};

// Known for FBX (from its settings), glTF (metres, +Y, by definition) and COLLADA (Assimp's root node turns
// and scales to metres, +Y); `format` is the importer's name.
Conventions conventions_of(const aiScene& scene, const std::string& format);

struct Appearance {
  std::vector<mesh::Material> materials;   // one per material of the scene
  std::vector<mesh::Texture> textures;     // base colour textures, each once
  std::vector<std::string> texture_files;  // per texture: what to open; empty: embedded, or not there
  std::vector<std::vector<std::uint8_t>> converted;  // keeps the bytes of textures that Assimp had decoded
};

// Spans of embedded textures point into `scene`; raw texels become a TGA image. Every texture of every
// material is looked up through `files`, so that the content key covers it; missing ones become one warning.
Appearance collect_appearance(const aiScene& scene, AssetFiles& files, std::vector<std::string>& warnings);

// The "materials" of scene_wire.h.
void write_materials(std::span<const mesh::Material> materials, wire::Writer& writer);

}  // namespace scene_analyzer::import
