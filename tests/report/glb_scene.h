// glb_scene.h — Small scenes to export as GLB, and an exported file taken apart.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/glb.h"

namespace scene_analyzer::report {

using Position = std::array<float, 3>;

// Scenes with their analyses; figures are made up, different for every instance.
class ExportedScene {
 public:
  // Meshes and instances go to the asset added last.
  void add_asset(const std::string& path);
  std::uint32_t add_mesh(const std::string& name, std::vector<float> positions,
                         std::vector<std::uint32_t> indices);
  void add_instance(std::uint32_t mesh, const std::string& node,
                    const mesh::Matrix4& world = mesh::kIdentity4,
                    const std::optional<ratings::Rgb>& color = std::nullopt);

  mesh::Scene& scene() { return scenes_.back(); }
  analysis::AssetAnalysis& analysis() { return assets_.back(); }
  const std::vector<mesh::Scene>& scenes() const { return scenes_; }
  const std::vector<std::optional<ratings::Rgb>>& colors() const { return colors_; }

  SceneReport report() const;  // rated anew at every call
  std::string file() const;

 private:
  std::vector<mesh::Scene> scenes_;
  std::vector<analysis::AssetAnalysis> assets_;
  std::vector<std::optional<ratings::Rgb>> colors_;
};

// Two assets: "room.glb" with a tetrahedron twice and a square once, "part.fbx", +Z up and in centimetres,
// with a sheared square.
ExportedScene two_exported_assets();

// One asset with one instance.
ExportedScene one_mesh(std::vector<float> positions, std::vector<std::uint32_t> indices,
                       const mesh::Matrix4& world = mesh::kIdentity4);

std::vector<float> tetrahedron_positions();
std::vector<std::uint32_t> tetrahedron_indices();
// `count` vertices, the same at every call.
std::vector<float> many_positions(std::size_t count);
inline constexpr mesh::Matrix4 kShear = {1, 0.5, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
inline constexpr ratings::Rgb kRed = {1, 0, 0};
inline constexpr ratings::Rgb kGreen = {0, 1, 0};

// An exported file. Reading one throws std::runtime_error, with the place, where the container's rules or
// those of glTF's accessors are broken.
class ParsedGlb {
 public:
  explicit ParsedGlb(const std::string& file);

  nlohmann::ordered_json json;
  std::string binary;

  // The node of a row: those of assets come first.
  const nlohmann::ordered_json& instance(std::size_t row) const;
  const nlohmann::ordered_json& primitive_of(std::size_t row) const;
  std::size_t position_accessor(std::size_t row) const;
  std::vector<Position> positions(std::size_t accessor) const;
  std::vector<std::uint32_t> indices(std::size_t accessor) const;
  std::vector<std::array<std::uint16_t, 4>> colors(std::size_t accessor) const;
  // Of the row's mesh, which has one colour: "#rrggbb" in sRGB, from its linear values.
  std::string color_of(std::size_t row) const;

 private:
  template <typename T, std::size_t N>
  std::vector<std::array<T, N>> elements(std::size_t accessor, int component_type,
                                         const std::string& type) const;
  void check_accessor(std::size_t index) const;
  void check_views() const;
  void check_primitives() const;
};

}  // namespace scene_analyzer::report
