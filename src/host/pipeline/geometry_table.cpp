#include "pipeline/geometry_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "analysis_file/hash.h"

namespace scene_analyzer::pipeline {
namespace {

using Key = std::pair<std::uint32_t, std::array<std::uint64_t, 9>>;

Key key_of(std::uint32_t mesh, const mesh::Matrix3& linear) {
  Key key{mesh, {}};
  std::transform(linear.begin(), linear.end(), key.second.begin(),
                 [](double value) { return std::bit_cast<std::uint64_t>(value); });
  return key;
}

}  // namespace

mesh::Matrix3 linear_part(const mesh::Matrix4& world) {
  return {world[0], world[1], world[2], world[4], world[5], world[6], world[8], world[9], world[10]};
}

std::optional<double> similarity_scale_squared(const mesh::Matrix4& world) {
  const mesh::Matrix3 a = linear_part(world);
  mesh::Matrix3 product{};  // A^T A
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t k = 0; k < 3; ++k) product[3 * row + column] += a[3 * k + row] * a[3 * k + column];
  const double squared = (product[0] + product[4] + product[8]) / 3;
  if (!(squared > 0) || !std::isfinite(squared)) return std::nullopt;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      if (!(std::abs(product[3 * row + column] - (row == column ? squared : 0)) <= 1e-6 * squared))
        return std::nullopt;
  return squared;
}

std::array<std::uint64_t, 2> shape_hash(const mesh::TriangleMesh& mesh) {
  const auto bytes = [](const auto& values) {
    const auto all = std::as_bytes(values);
    return std::string_view(reinterpret_cast<const char*>(all.data()), all.size());
  };
  analysis_file::Hasher hasher;
  hasher.add(bytes(mesh.indices));
  hasher.add(bytes(mesh.positions));
  return hasher.digest();
}

GeometryTable make_geometry_table(const mesh::Scene& scene) {
  GeometryTable table;
  std::map<Key, std::uint32_t> known;
  std::vector<std::optional<std::array<std::uint64_t, 2>>> hashes(scene.meshes.size());
  for (const mesh::Instance& instance : scene.instances) {
    const std::optional<double> scale = similarity_scale_squared(instance.world);
    const mesh::Matrix3 linear = scale ? mesh::kIdentity3 : linear_part(instance.world);
    const auto [entry, added] =
        known.try_emplace(key_of(instance.mesh, linear), static_cast<std::uint32_t>(table.geometries.size()));
    if (added) {
      analysis::GeometryAnalysis geometry;
      geometry.mesh = instance.mesh;
      geometry.linear = linear;
      const mesh::TriangleMesh& mesh = scene.meshes[instance.mesh];
      geometry.source_triangles = mesh.triangle_count();
      if (geometry.source_triangles > 0) {
        auto& hash = hashes[instance.mesh];  // several linear parts may share it
        if (!hash) hash = shape_hash(mesh);
        geometry.shape_hash = hash;
      }
      table.geometries.push_back(std::move(geometry));
    }
    table.instances.push_back({.geometry = entry->second,
                               .node = instance.node,
                               .mesh = scene.meshes[instance.mesh].name,
                               .area_scale = scale.value_or(1),
                               .world = instance.world,
                               .bounds = std::nullopt});
  }
  return table;
}

std::optional<analysis::Bounds> carry_bounds(const analysis::Bounds& local, const mesh::Matrix4& world) {
  analysis::Bounds carried;
  for (std::size_t row = 0; row < 3; ++row) {
    std::optional<std::size_t> only;
    for (std::size_t column = 0; column < 3; ++column) {
      if (world[4 * row + column] == 0) continue;
      if (only) return std::nullopt;
      only = column;
    }
    const std::size_t column = only.value_or(0);
    const double factor = world[4 * row + column], offset = world[4 * row + 3];
    const double one = factor * local.min[column] + offset, other = factor * local.max[column] + offset;
    carried.min[row] = std::min(one, other);
    carried.max[row] = std::max(one, other);
  }
  return carried;
}

}  // namespace scene_analyzer::pipeline
