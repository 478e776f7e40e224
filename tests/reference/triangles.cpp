#include "reference/triangles.h"

#include <algorithm>
#include <cmath>

namespace scene_analyzer::reference {
namespace {

constexpr double kLeastHeight = 1e-6;  // relative to the longest edge

mesh::Vector3 difference(const mesh::Vector3& a, const mesh::Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double length(const mesh::Vector3& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

mesh::Vector3 cross(const mesh::Vector3& a, const mesh::Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool finite(const mesh::Vector3& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

void include(std::optional<LocalBounds>& bounds, const float* place) {
  if (!bounds) bounds = LocalBounds{{place[0], place[1], place[2]}, {place[0], place[1], place[2]}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds->min[axis] = std::min(bounds->min[axis], place[axis]);
    bounds->max[axis] = std::max(bounds->max[axis], place[axis]);
  }
}

struct Single {
  double area = 0, height = 0;
};

// Nothing for a degenerate triangle.
std::optional<Single> measure(const std::array<std::uint32_t, 3>& corners,
                              const std::array<mesh::Vector3, 3>& points) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return std::nullopt;
  if (!finite(points[0]) || !finite(points[1]) || !finite(points[2])) return std::nullopt;
  const mesh::Vector3 ab = difference(points[1], points[0]);
  const mesh::Vector3 ac = difference(points[2], points[0]);
  const double longest = std::max({length(ab), length(ac), length(difference(points[2], points[1]))});
  const double twice_area = length(cross(ab, ac));
  const double height = twice_area / longest;
  if (!(height > kLeastHeight * longest))
    return std::nullopt;  // also 0 / 0, where A flattens the triangle to a point
  return Single{twice_area / 2, height};
}

}  // namespace

TriangleMeasures measure_triangles(const Geometry& geometry) {
  const std::uint32_t count = geometry.triangle_count();
  TriangleMeasures result;
  result.kept.resize(count);
  result.area.resize(count);
  result.height.resize(count);
  result.centroid.resize(count);
  long double surface_area = 0;
  for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
    std::array<std::uint32_t, 3> corners{};
    std::array<mesh::Vector3, 3> points{};
    for (std::uint32_t c = 0; c < 3; ++c) {
      corners[c] = geometry.corner(triangle, c);
      points[c] = geometry.point(corners[c]);
    }
    const std::optional<Single> single = measure(corners, points);
    if (!single) continue;
    result.kept[triangle] = 1;
    ++result.kept_count;
    result.area[triangle] = single->area;
    result.height[triangle] = single->height;
    surface_area += single->area;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result.centroid[triangle][axis] = (points[0][axis] + points[1][axis] + points[2][axis]) / 3;
    for (std::uint32_t c = 0; c < 3; ++c) {
      include(result.bounds, &geometry.positions[3 * std::size_t{corners[c]}]);
      for (const double coordinate : points[c])
        result.largest_coordinate = std::max(result.largest_coordinate, std::abs(coordinate));
    }
  }
  result.surface_area = static_cast<double>(surface_area);
  return result;
}

}  // namespace scene_analyzer::reference
