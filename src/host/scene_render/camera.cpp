#include "scene_render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ratings/ratings.h"

namespace scene_analyzer::scene_render {
namespace {

using mesh::Vector3;

constexpr double kMargin = 1.06;  // around the scene
const double kWidest = std::tan(std::numbers::pi / 6), kUsual = std::tan(std::numbers::pi / 8);

double length(const Vector3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

Vector3 scaled(const Vector3& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

Vector3 difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 middle(const analysis::Bounds& bounds) {
  Vector3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = bounds.min[axis] / 2 + bounds.max[axis] / 2;
  return result;
}

Vector3 corner(const analysis::Bounds& bounds, unsigned number) {
  Vector3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = (number >> axis & 1) != 0 ? bounds.max[axis] : bounds.min[axis];
  return result;
}

Vector3 transformed(const std::array<double, 12>& matrix, const Vector3& point) {
  Vector3 result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = matrix[4 * row] * point[0] + matrix[4 * row + 1] * point[1] +
                  matrix[4 * row + 2] * point[2] + matrix[4 * row + 3];
  return result;
}

// Fills the picture with the scene, where all of its corners are in front of the eye and 60 degrees are
// enough.
void show_all(const analysis::Bounds& scene, double aspect, Camera& camera) {
  const std::array<double, 12> view = view_matrix(camera);
  std::array<double, 2> least = {HUGE_VAL, HUGE_VAL}, most = {-HUGE_VAL, -HUGE_VAL};
  for (unsigned number = 0; number < 8; ++number) {
    const Vector3 seen = transformed(view, corner(scene, number));
    if (seen[2] >= -1e-3) return;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      least[axis] = std::min(least[axis], seen[axis] / -seen[2]);
      most[axis] = std::max(most[axis], seen[axis] / -seen[2]);
    }
  }
  const double height = most[1] - least[1], width = most[0] - least[0];
  if (std::max(height, width) > 2 * kWidest || !(std::max(height, width) > 0)) return;
  const double tangent = kMargin * std::max(height, width / aspect) / 2;
  camera.tangent = tangent;
  camera.middle = {(least[0] + most[0]) / 2, (least[1] + most[1]) / 2};
}

// In the direction of `wanted`, as far away as the scene is large or distant: a target may be meant as a
// direction, and distances in the view are in units of this one.
Vector3 usual_target(const analysis::Bounds& scene, const Vector3& eye, const Vector3& wanted) {
  const double size = length(difference(scene.max, scene.min)), away = length(difference(middle(scene), eye));
  double distance = std::max(size, away);
  if (!(distance > 0)) distance = 1;  // one point is all there is to see
  const Vector3 towards = difference(wanted, eye);
  const double given = length(towards);
  Vector3 direction = {0, 0, -1};  // where the target is the eye
  if (given > 1e-9 * distance) direction = scaled(towards, 1 / given);
  Vector3 target = eye;
  for (std::size_t axis = 0; axis < 3; ++axis) target[axis] += distance * direction[axis];
  return target;
}

}  // namespace

Camera make_camera(const analysis::Bounds& scene, const std::optional<Vector3>& eye,
                   const std::optional<Vector3>& target, double aspect) {
  Camera camera;
  camera.eye = eye.value_or(ratings::default_eye(scene));
  camera.target = usual_target(scene, camera.eye, target.value_or(middle(scene)));
  const Vector3 direction = difference(camera.target, camera.eye);
  // Straight up or down there is no up in the picture.
  if (std::abs(direction[1]) > 0.999999 * length(direction))
    camera.up = {0, 0, direction[1] > 0 ? 1.0 : -1.0};
  camera.tangent = target ? kUsual : kWidest;
  if (!target) show_all(scene, aspect, camera);
  return camera;
}

std::array<double, 12> view_matrix(const Camera& camera) {
  const Vector3 direction = difference(camera.target, camera.eye);
  const double distance = length(direction);
  const Vector3 back = scaled(direction, -1 / distance);
  Vector3 right = cross(camera.up, back);
  right = scaled(right, 1 / length(right));
  const Vector3 up = cross(back, right);
  std::array<double, 12> view{};
  std::size_t row = 0;
  for (const Vector3& axis : {right, up, back}) {
    for (std::size_t column = 0; column < 3; ++column) {
      view[4 * row + column] = axis[column] / distance;
      view[4 * row + 3] -= axis[column] * camera.eye[column] / distance;
    }
    ++row;
  }
  return view;
}

std::optional<Projected> project(const Camera& camera, double aspect, const Vector3& point) {
  const Vector3 seen = transformed(view_matrix(camera), point);
  if (!(seen[2] < 0)) return std::nullopt;
  const double distance = length(difference(camera.target, camera.eye));
  return Projected{.x = (seen[0] / -seen[2] - camera.middle[0]) / (camera.tangent * aspect),
                   .y = (seen[1] / -seen[2] - camera.middle[1]) / camera.tangent,
                   .unit = 1 / (distance * -seen[2] * camera.tangent)};
}

}  // namespace scene_analyzer::scene_render
