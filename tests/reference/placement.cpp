#include "reference/placement.h"

#include <algorithm>
#include <cmath>

namespace scene_analyzer::reference {

Placement placement_of(const mesh::Matrix4& world) {
  const mesh::Matrix3 a = {world[0], world[1], world[2], world[4], world[5],
                           world[6], world[8], world[9], world[10]};
  const auto product = [&](std::size_t i, std::size_t j) {
    return a[i] * a[j] + a[3 + i] * a[3 + j] + a[6 + i] * a[6 + j];
  };
  const double squared_scale = (product(0, 0) + product(1, 1) + product(2, 2)) / 3;
  bool similarity = squared_scale > 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      similarity =
          similarity && std::abs(product(i, j) - (i == j ? squared_scale : 0)) <= 1e-6 * squared_scale;
  return similarity ? Placement{mesh::kIdentity3, squared_scale} : Placement{a, 1};
}

std::optional<analysis::Bounds> world_bounds(const Geometry& geometry, const TriangleMeasures& triangles,
                                             const mesh::Matrix4& world) {
  std::optional<analysis::Bounds> bounds;
  for (std::uint32_t triangle = 0; triangle < triangles.kept.size(); ++triangle) {
    if (!triangles.kept[triangle]) continue;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const float* local = &geometry.positions[3 * std::size_t{geometry.corner(triangle, c)}];
      mesh::Vector3 point{};
      for (std::size_t row = 0; row < 3; ++row)
        point[row] = world[4 * row] * local[0] + world[4 * row + 1] * local[1] +
                     world[4 * row + 2] * local[2] + world[4 * row + 3];
      if (!bounds) bounds = analysis::Bounds{point, point};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds->min[axis] = std::min(bounds->min[axis], point[axis]);
        bounds->max[axis] = std::max(bounds->max[axis], point[axis]);
      }
    }
  }
  return bounds;
}

}  // namespace scene_analyzer::reference
