// distance.cpp — Distance of meshes to the eye, and where the eye stands when nobody said so.
#include <algorithm>
#include <cmath>

#include "ratings/ratings.h"
#include "ratings/unit_range.h"

namespace scene_analyzer::ratings {

double distance_to(const analysis::Bounds& bounds, const mesh::Vector3& eye) {
  mesh::Vector3 outside{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    outside[axis] = std::max({bounds.min[axis] - eye[axis], eye[axis] - bounds.max[axis], 0.0});
  return std::hypot(outside[0], outside[1], outside[2]);  // hypot: the squares could overflow
}

std::vector<double> distance_ratings(std::span<const double> distances) {
  return onto_unit_range(distances, 1e-6);
}

mesh::Vector3 default_eye(const analysis::Bounds& scene) {
  mesh::Vector3 center{}, half{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Halved before they are added: the sum of two huge coordinates would overflow.
    center[axis] = scene.min[axis] / 2 + scene.max[axis] / 2;
    half[axis] = scene.max[axis] / 2 - scene.min[axis] / 2;
  }
  const double diagonal = 2 * std::hypot(half[0], half[1], half[2]);
  const mesh::Vector3 direction = {0.6, 0.48, 0.64};  // of length 1: from the right, above and in front
  mesh::Vector3 eye{};
  for (std::size_t axis = 0; axis < 3; ++axis) eye[axis] = center[axis] + 1.2 * diagonal * direction[axis];
  return eye;
}

}  // namespace scene_analyzer::ratings
