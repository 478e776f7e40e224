#include "import/appearance.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "import/warnings.h"

namespace scene_analyzer::import {
namespace {

// Importers of formats whose textures come from elsewhere put such a name into the material.
constexpr std::string_view kInventedName = "$texture_dummy";

std::optional<double> metadata_number(const aiMetadata& metadata, const char* key) {
  double wide = 0;
  if (metadata.Get(key, wide)) return wide;
  float narrow = 0;
  if (metadata.Get(key, narrow)) return narrow;
  std::int32_t integer = 0;
  if (metadata.Get(key, integer)) return integer;
  return std::nullopt;
}

Conventions fbx_conventions(const aiMetadata& metadata) {
  Conventions conventions;
  const std::optional<double> centimetres = metadata_number(metadata, "UnitScaleFactor");
  if (centimetres && std::isfinite(*centimetres) && *centimetres > 0)
    conventions.unit_scale = *centimetres / 100;
  const std::optional<double> axis = metadata_number(metadata, "UpAxis");
  const double sign = metadata_number(metadata, "UpAxisSign").value_or(1);
  if (axis && *axis >= 0 && *axis <= 2)
    conventions.up_axis = std::string(sign < 0 ? "-" : "+") + "XYZ"[static_cast<int>(*axis)];
  return conventions;
}

std::optional<std::array<float, 4>> base_color(const aiMaterial& material) {
  if (std::string_view(material.GetName().C_Str()) == AI_DEFAULT_MATERIAL_NAME) return std::nullopt;
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS &&
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS)
    return std::nullopt;
  std::array<float, 4> channels = {color.r, color.g, color.b, color.a};
  for (float& channel : channels) {
    if (std::isnan(channel)) return std::nullopt;
    channel = std::clamp(channel, 0.0f, 1.0f);
  }
  return channels;
}

// 32-bit uncompressed TGA, top row first: the simplest file that every image reader knows.
std::vector<std::uint8_t> as_tga(const aiTexture& texture) {
  const auto low = [](unsigned value) { return static_cast<std::uint8_t>(value & 0xFF); };
  const auto high = [](unsigned value) { return static_cast<std::uint8_t>(value >> 8 & 0xFF); };
  const unsigned width = texture.mWidth, height = texture.mHeight;
  if (width > 0xFFFF || height > 0xFFFF) return {};
  std::vector<std::uint8_t> bytes = {
      0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, low(width), high(width), low(height), high(height), 32, 0x28};
  bytes.reserve(bytes.size() + std::size_t{4} * width * height);
  for (const aiTexel& texel : std::span(texture.pcData, std::size_t{width} * height))
    bytes.insert(bytes.end(), {texel.b, texel.g, texel.r, texel.a});
  return bytes;
}

class Collector {
 public:
  Collector(const aiScene& scene, AssetFiles& files) : scene_(scene), files_(files) {}

  void add(const aiMaterial& material) {
    mesh::Material& added = result_.materials.emplace_back();
    added.name = material.GetName().C_Str();
    added.base_color = base_color(material);
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type)
      look_up_textures(material, static_cast<aiTextureType>(type));
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
      aiString path;
      if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) continue;
      if (std::string_view(path.C_Str()).starts_with(kInventedName)) continue;
      added.texture = texture(path);
      break;
    }
  }

  Appearance take() { return std::move(result_); }
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  void look_up_textures(const aiMaterial& material, aiTextureType type) {
    for (unsigned i = 0; i < material.GetTextureCount(type); ++i) {
      aiString path;
      if (material.GetTexture(type, i, &path) != aiReturn_SUCCESS || path.length == 0) continue;
      if (std::string_view(path.C_Str()).starts_with(kInventedName)) continue;
      if (!seen_.emplace(path.C_Str()).second || scene_.GetEmbeddedTexture(path.C_Str())) continue;
      const AssetFiles::Found found = files_.find(path.C_Str());
      if (found.kind == Reference::Kind::kInside && !AssetFiles::readable(found.path))
        missing_.push_back(path.C_Str());
    }
  }

  std::uint32_t texture(const aiString& path) {
    const auto [entry, is_new] =
        numbers_.try_emplace(path.C_Str(), static_cast<std::uint32_t>(result_.textures.size()));
    if (!is_new) return entry->second;
    mesh::Texture& added = result_.textures.emplace_back();
    std::string& file = result_.texture_files.emplace_back();
    const aiTexture* embedded = scene_.GetEmbeddedTexture(path.C_Str());
    if (embedded == nullptr) {
      added.path = path.C_Str();
      const AssetFiles::Found found = files_.find(path.C_Str());
      if (AssetFiles::readable(found.path)) file = found.path;
    } else if (embedded->mHeight == 0) {
      added.path = embedded->mFilename.C_Str();
      added.encoded = {reinterpret_cast<const std::uint8_t*>(embedded->pcData), embedded->mWidth};
    } else {
      added.path = embedded->mFilename.C_Str();
      added.encoded = result_.converted.emplace_back(as_tga(*embedded));
    }
    return entry->second;
  }

  const aiScene& scene_;
  AssetFiles& files_;
  Appearance result_;
  std::map<std::string, std::uint32_t> numbers_;
  std::set<std::string> seen_;
  std::vector<std::string> missing_;
};

}  // namespace

Conventions conventions_of(const aiScene& scene, const std::string& format) {
  if (format.starts_with("glTF") || format.starts_with("Collada")) return {1.0, "+Y"};
  if (format.find("FBX") != std::string::npos && scene.mMetaData != nullptr)
    return fbx_conventions(*scene.mMetaData);
  return {};
}

Appearance collect_appearance(const aiScene& scene, AssetFiles& files, std::vector<std::string>& warnings) {
  Collector collector(scene, files);
  for (const aiMaterial* material : std::span(scene.mMaterials, scene.mNumMaterials))
    collector.add(*material);
  warn_about_list(collector.missing(), "texture", "is missing or cannot be read",
                  "are missing or cannot be read", warnings);
  return collector.take();
}

void write_materials(std::span<const mesh::Material> materials, wire::Writer& writer) {
  writer.number(std::uint64_t{materials.size()});
  for (const mesh::Material& material : materials) {
    writer.string(material.name);
    writer.number(std::uint8_t{material.base_color.has_value()});
    for (const float channel : material.base_color.value_or(std::array<float, 4>{})) writer.number(channel);
    writer.number(std::uint8_t{material.texture.has_value()});
    writer.number(material.texture.value_or(0));
  }
}

}  // namespace scene_analyzer::import
