// geometry.h — A welded mesh as the twins see it: a view over the caller's arrays.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "mesh/scene.h"

namespace scene_analyzer::reference {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The arrays must outlive the view.
struct Geometry {
  std::span<const float> positions;               // x, y, z per vertex, as in the file
  std::span<const std::uint32_t> indices;         // three per triangle
  std::span<const std::uint32_t> representative;  // per vertex, of weld()
  mesh::Matrix3 linear = mesh::kIdentity3;        // A of the analysed coordinates A p

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(indices.size() / 3); }

  // Welded vertex at corner 0, 1 or 2.
  std::uint32_t corner(std::uint32_t triangle, std::uint32_t which) const {
    return representative[indices[3 * std::size_t{triangle} + which]];
  }
  std::uint32_t half_edge_from(std::uint32_t half_edge) const { return representative[indices[half_edge]]; }
  std::uint32_t half_edge_to(std::uint32_t half_edge) const {
    return representative[indices[half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1]];
  }

  // Analysed coordinates of a vertex.
  mesh::Vector3 point(std::uint32_t vertex) const {
    const double x = positions[3 * std::size_t{vertex}];
    const double y = positions[3 * std::size_t{vertex} + 1];
    const double z = positions[3 * std::size_t{vertex} + 2];
    return {linear[0] * x + linear[1] * y + linear[2] * z, linear[3] * x + linear[4] * y + linear[5] * z,
            linear[6] * x + linear[7] * y + linear[8] * z};
  }
};

}  // namespace scene_analyzer::reference
