// triangles.h — Areas, heights and centroids, and which triangles count.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "reference/geometry.h"

namespace scene_analyzer::reference {

struct LocalBounds {
  std::array<float, 3> min{};
  std::array<float, 3> max{};
};

// Per triangle of the file; area, height and centroid are 0 where the triangle is not kept. Analysed
// coordinates but for `bounds`.
struct TriangleMeasures {
  std::vector<std::uint8_t> kept;  // 0: degenerate
  std::vector<double> area;
  std::vector<double> height;  // the least one: 2 area / longest edge
  std::vector<mesh::Vector3> centroid;
  std::uint64_t kept_count = 0;
  double surface_area = 0;
  double largest_coordinate = 0;  // largest |coordinate| of kept triangles' vertices
  std::optional<LocalBounds>
      bounds;  // of kept triangles' welded vertices, file coordinates; absent when none is kept
};

// A triangle is degenerate when two welded corners are equal, a coordinate is not finite, or height <= 1e-6 x
// longest edge. Linear.
TriangleMeasures measure_triangles(const Geometry& geometry);

}  // namespace scene_analyzer::reference
