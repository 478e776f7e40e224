#include "import/gltf_check.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "import/gltf_accessor.h"
#include "import/gltf_document.h"
#include "import/gltf_nodes.h"
#include "import/scene_writer.h"

namespace scene_analyzer::import {
namespace {

using nlohmann::json;

// They change how surfaces look or how they are stored where Assimp decodes it, never where vertices are.
constexpr std::array<std::string_view, 10> kTestedExtensions = {"KHR_draco_mesh_compression",
                                                                "KHR_lights_punctual",
                                                                "KHR_texture_basisu",
                                                                "KHR_texture_transform",
                                                                "KHR_xmp",
                                                                "KHR_xmp_json_ld",
                                                                "EXT_texture_webp",
                                                                "EXT_texture_avif",
                                                                "MSFT_texture_dds",
                                                                "EXT_lights_image_based"};

enum Mode : std::uint64_t {
  kPoints,
  kLines,
  kLineLoop,
  kLineStrip,
  kTriangles,
  kTriangleStrip,
  kTriangleFan
};

void check_extensions(const json& root) {
  for (const json& extension : array_of(root, "extensionsRequired", "the file")) {
    if (!extension.is_string()) throw InputError("\"extensionsRequired\" holds something that is not a name");
    const std::string& name = extension.get_ref<const std::string&>();
    if (!is_tested_extension(name))
      throw InputError("it requires the glTF extension " + name +
                       ", which is not supported; export it without that extension");
  }
}

bool has_skin_without_matrices(const json& root) {
  const json& skins = array_of(root, "skins", "the file");
  return std::any_of(skins.begin(), skins.end(), [](const json& skin) {
    return skin.is_object() && !skin.contains("inverseBindMatrices");
  });
}

class Checker {
 public:
  Checker(const GltfDocument& document, std::vector<std::string>& warnings)
      : document_(document), accessors_(document), warnings_(warnings) {}

  std::uint64_t run() {
    accessors_.check_views();
    const json& meshes = array_of(document_.root, "meshes", "the file");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const std::string where = "mesh " + std::to_string(i);
      if (!meshes[i].is_object()) throw InputError(where + " is not an object");
      std::uint64_t triangles = 0;
      const json& primitives = array_of(meshes[i], "primitives", where);
      for (std::size_t k = 0; k < primitives.size(); ++k)
        triangles += check_primitive(primitives[k], where + " primitive " + std::to_string(k));
      triangles_.push_back(triangles);
    }
    return triangles_of_shown_meshes();
  }

 private:
  // Triangles of the primitive.
  std::uint64_t check_primitive(const json& primitive, const std::string& where) {
    const std::uint64_t mode = whole_number(primitive, "mode", kTriangles, where);
    if (mode > kTriangleFan) throw InputError(where + " has the unknown mode " + std::to_string(mode));
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
      throw InputError(where + " has no \"attributes\"");
    if (!attributes->contains("POSITION")) {
      warnings_.push_back(where + " has no positions and is left out");
      return 0;
    }
    const bool compressed = is_compressed(primitive);
    const std::uint64_t vertices =
        accessors_.check_positions(whole_number(*attributes, "POSITION", where), compressed, where);
    if (attributes->contains("TEXCOORD_0"))
      accessors_.check_texture_coordinates(whole_number(*attributes, "TEXCOORD_0", where), compressed,
                                           vertices, where);
    std::uint64_t corners = vertices;
    if (primitive.contains("indices"))
      corners =
          accessors_.check_indices(whole_number(primitive, "indices", where), compressed, vertices, where);
    return triangles_of(mode, corners, where);
  }

  std::uint64_t triangles_of(std::uint64_t mode, std::uint64_t corners, const std::string& where) {
    if (mode < kTriangles) return 0;
    if (mode != kTriangles) return corners < 3 ? 0 : corners - 2;
    if (corners % 3 != 0)
      warnings_.push_back(where + " has " + std::to_string(corners) +
                          " corners, which are not whole triangles; the last ones are left out");
    return corners / 3;
  }

  static bool is_compressed(const json& primitive) {
    const auto extensions = primitive.find("extensions");
    return extensions != primitive.end() && extensions->is_object() &&
           extensions->contains("KHR_draco_mesh_compression");
  }

  std::uint64_t triangles_of_shown_meshes() {
    const std::vector<bool> shown = find_shown_meshes(document_.root, triangles_.size(), warnings_);
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) total += shown[i] ? triangles_[i] : 0;
    return total;
  }

  const GltfDocument& document_;
  GltfAccessors accessors_;
  std::vector<std::string>& warnings_;
  std::vector<std::uint64_t> triangles_;  // per mesh of the file
};

}  // namespace

bool is_tested_extension(const std::string& name) {
  return name.starts_with("KHR_materials_") ||
         std::find(kTestedExtensions.begin(), kTestedExtensions.end(), name) != kTestedExtensions.end();
}

ExpectedGltf check_gltf(AssetFiles& files, std::vector<std::string>& warnings) {
  std::optional<GltfDocument> document = open_gltf(files, warnings);
  if (!document) return {};
  check_extensions(document->root);  // first: an extension may say where buffers are
  load_buffers(*document, files);
  ExpectedGltf expected;
  expected.triangles = Checker(*document, warnings).run();
  expected.materials = array_of(document->root, "materials", "the file").size();
  expected.replacement = document->behind_mark;
  if (has_skin_without_matrices(document->root)) expected.replacement = without_skins(*document);
  return expected;
}

void require_expected(const ExpectedGltf& expected, const aiScene& scene) {
  if (!expected.triangles) return;
  const std::uint64_t read = count_triangles(scene);
  if (read == *expected.triangles) return;
  throw InputError("Assimp reads " + std::to_string(read) + " triangles where the file has " +
                   std::to_string(*expected.triangles) + "; it is not analysed to avoid wrong figures");
}

}  // namespace scene_analyzer::import
