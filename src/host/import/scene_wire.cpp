#include "import/scene_wire.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "import/text.h"

namespace scene_analyzer::import {
namespace {

std::string name(wire::Reader& reader) {
  return clean_text(reader.string());
}

void require(bool condition, const char* what) {
  if (!condition) throw wire::Malformed(what);
}

void read_files(wire::Reader& reader, mesh::Scene& scene) {
  scene.files.resize(reader.count(9));
  for (mesh::ReferencedFile& file : scene.files) {
    file.path = clean_text(reader.string(), 4096);
    file.found = reader.number<std::uint8_t>() != 0;
  }
}

void read_textures(wire::Reader& reader, mesh::Scene& scene) {
  scene.textures.resize(reader.count(48));
  for (mesh::Texture& texture : scene.textures) {
    texture.path = name(reader);
    texture.encoded = reader.array<std::uint8_t>();
    texture.width = reader.number<std::uint32_t>();
    texture.height = reader.number<std::uint32_t>();
    texture.pixels = reader.array<std::uint8_t>();
    require(texture.width <= mesh::kLongestTextureSide && texture.height <= mesh::kLongestTextureSide,
            "a texture is larger than agreed");
    require((texture.width == 0) == (texture.height == 0), "a texture has no pixels in one direction");
    require(texture.pixels.size() == std::size_t{4} * texture.width * texture.height,
            "a texture has pixels for another size");
  }
}

void read_materials(wire::Reader& reader, mesh::Scene& scene) {
  scene.materials.resize(reader.count(30));
  for (mesh::Material& material : scene.materials) {
    material.name = name(reader);
    const bool has_color = reader.number<std::uint8_t>() != 0;
    std::array<float, 4> color;
    for (float& channel : color) channel = reader.number<float>();
    require(!has_color || std::ranges::all_of(color, [](float c) { return c >= 0 && c <= 1; }),
            "a material's colour is none");
    if (has_color) material.base_color = color;
    const bool has_texture = reader.number<std::uint8_t>() != 0;
    const auto texture = reader.number<std::uint32_t>();
    require(!has_texture || texture < scene.textures.size(), "a material's texture is unknown");
    if (has_texture) material.texture = texture;
  }
}

// The whole pass runs without a branch per index; only a bad mesh is searched for the place.
void check_indices(const mesh::TriangleMesh& mesh, std::size_t number) {
  if (mesh.indices.empty()) return;
  std::uint32_t largest = 0;
  for (const std::uint32_t index : mesh.indices) largest = std::max(largest, index);
  if (largest < mesh.vertex_count()) return;
  const auto bad = std::find_if(mesh.indices.begin(), mesh.indices.end(),
                                [&](std::uint32_t index) { return index >= mesh.vertex_count(); });
  throw InputError("triangle " + std::to_string((bad - mesh.indices.begin()) / 3) + " of mesh " +
                   std::to_string(number) + (mesh.name.empty() ? "" : " \"" + mesh.name + "\"") +
                   " asks for vertex " + std::to_string(*bad) + " of " + std::to_string(mesh.vertex_count()));
}

void read_meshes(wire::Reader& reader, mesh::Scene& scene) {
  scene.meshes.resize(reader.count(68));
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    mesh::TriangleMesh& mesh = scene.meshes[i];
    mesh.name = name(reader);
    mesh.positions = reader.array<float>();
    mesh.indices = reader.array<std::uint32_t>();
    mesh.texture_coordinates = reader.array<float>();
    mesh.material = reader.number<std::uint32_t>();
    mesh.skipped_primitives = reader.number<std::uint64_t>();
    require(mesh.positions.size() % 3 == 0 && mesh.indices.size() % 3 == 0,
            "a mesh has a part of a triangle");
    require(mesh.vertex_count() <= std::numeric_limits<std::uint32_t>::max(), "a mesh has too many vertices");
    require(mesh.texture_coordinates.empty() || mesh.texture_coordinates.size() == 2 * mesh.vertex_count(),
            "a mesh has texture coordinates for other vertices");
    require(mesh.material < scene.materials.size(), "a mesh's material is unknown");
    check_indices(mesh, i);
  }
}

// Also without a branch: files of many vertices are the rule, such vertices are not.
bool all_finite(std::span<const float> values) {
  constexpr std::uint32_t kMagnitude = 0x7FFFFFFF, kInfinity = 0x7F800000;
  std::uint32_t largest = 0;
  for (const float value : values)
    largest = std::max(largest, std::bit_cast<std::uint32_t>(value) & kMagnitude);
  return largest < kInfinity;
}

// What is no number cannot be measured; metrics.md says what becomes of it.
void warn_about_numbers(mesh::Scene& scene) {
  std::size_t meshes = 0, nodes = 0;
  std::uint64_t vertices = 0;
  for (const mesh::TriangleMesh& mesh : scene.meshes) {
    if (all_finite(mesh.positions)) continue;
    ++meshes;
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      vertices += all_finite(mesh.positions.subspan(i, 3)) ? 0 : 1;
  }
  for (const mesh::Instance& instance : scene.instances)
    nodes +=
        std::ranges::all_of(instance.world, [](double element) { return std::isfinite(element); }) ? 0 : 1;
  if (vertices > 0)
    scene.warnings.push_back(
        std::to_string(vertices) + (vertices == 1 ? " vertex" : " vertices") + " of " +
        std::to_string(meshes) + (meshes == 1 ? " mesh" : " meshes") +
        " with coordinates that are no finite numbers; triangles with them count as degenerate");
  if (nodes > 0)
    scene.warnings.push_back(std::to_string(nodes) + (nodes == 1 ? " instance" : " instances") +
                             " of meshes whose node's matrix holds what is no finite number");
}

void read_instances(wire::Reader& reader, mesh::Scene& scene) {
  scene.instances.resize(reader.count(140));
  for (mesh::Instance& instance : scene.instances) {
    instance.mesh = reader.number<std::uint32_t>();
    require(instance.mesh < scene.meshes.size(), "a node's mesh is unknown");
    instance.node = name(reader);
    for (double& element : instance.world) element = reader.number<double>();
  }
}

}  // namespace

mesh::Scene read_scene(wire::Reader& reader) {
  mesh::Scene scene;
  scene.format = name(reader);
  const bool has_unit = reader.number<std::uint8_t>() != 0;
  const auto unit = reader.number<double>();
  require(!has_unit || (std::isfinite(unit) && unit > 0), "a unit is no length");
  if (has_unit) scene.unit_scale = unit;
  const bool has_up = reader.number<std::uint8_t>() != 0;
  std::string up = name(reader);
  constexpr std::array<std::string_view, 6> kAxes = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
  require(!has_up || std::ranges::find(kAxes, up) != kAxes.end(), "an axis is none");
  if (has_up) scene.up_axis = std::move(up);
  read_files(reader, scene);
  read_textures(reader, scene);
  read_materials(reader, scene);
  scene.warnings.resize(reader.count(8));
  for (std::string& warning : scene.warnings) warning = clean_text(reader.string(), 2048);
  read_meshes(reader, scene);
  read_instances(reader, scene);
  warn_about_numbers(scene);
  return scene;
}

}  // namespace scene_analyzer::import
