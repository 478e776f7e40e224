#include "viewer/navigation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>

#include "ratings/ratings.h"

namespace scene_analyzer::viewer {
namespace {

using analysis::Bounds;
using mesh::Vector3;

constexpr double kPi = std::numbers::pi;
const double kTangent = std::tan(kPi / 8);
constexpr double kMargin = 1.06;              // around what is to be seen
constexpr double kSteepest = kPi / 2 - 1e-3;  // beyond it the picture would have no upright
constexpr double kZoomStep = 0.9;
constexpr double kSpeed = 0.8;                       // distances per second
constexpr double kGrowth = 2;                        // per second
constexpr double kFarthest = 1000, kNearest = 1e-6;  // in diagonals of the scene
constexpr double kLargest = 1e150;                   // squares of coordinates stay finite
// In units of the coordinates: below it, rounding would show in the direction from eye to target.
constexpr double kResolution = 1e-9;

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double greatest_coordinate(const Vector3& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

bool all_finite(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

double cut(double coordinate) {
  return std::isnan(coordinate) ? 0 : std::clamp(coordinate, -kLargest, kLargest);
}

struct Box {
  Vector3 middle{}, half{};
  double size = 0;  // diagonal, not too small for the coordinates
};

Box box_of(const Bounds& bounds) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = cut(bounds.min[axis]), high = cut(bounds.max[axis]);
    box.middle[axis] = low / 2 + high / 2;
    box.half[axis] = std::abs(high / 2 - low / 2);
  }
  box.size = std::max(2 * std::hypot(box.half[0], box.half[1], box.half[2]),
                      kResolution * greatest_coordinate(box.middle));
  // One point in the origin: any size is as good.
  if (!(box.size > 1e-150)) box.size = 1;
  return box;
}

double usable_aspect(double aspect) {
  return std::isfinite(aspect) ? std::clamp(aspect, 0.01, 100.0) : 1;
}

}  // namespace

Navigation::Navigation() {
  show_all({.min = {-1, -1, -1}, .max = {1, 1, 1}}, 1);
}

void Navigation::extend(const Bounds& scene) {
  const Box box = box_of(scene);
  scene_middle_ = box.middle;
  scene_size_ = box.size;
  keep_within_limits();
}

void Navigation::show_all(const Bounds& scene, double aspect) {
  extend(scene);
  // The direction is the same for all scenes; this one has no rounding.
  const Vector3 direction = ratings::default_eye({.min = {-1, -1, -1}, .max = {1, 1, 1}});
  azimuth_ = std::atan2(direction[0], direction[2]);
  elevation_ = std::atan2(direction[1], std::hypot(direction[0], direction[2]));
  fit(scene, aspect);
}

void Navigation::frame(const Bounds& box, double aspect) {
  fit(box, aspect);
}

void Navigation::fit(const Bounds& bounds, double aspect) {
  const Box box = box_of(bounds);
  const Axes picture = axes();
  const double up = kTangent / kMargin, right = up * usable_aspect(aspect);
  // A corner is in view where it is at least as deep as it is far from the middle, divided by the tangent.
  double distance = 0;
  for (unsigned number = 0; number < 8; ++number) {
    Vector3 corner = box.half;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((number >> axis & 1) != 0) corner[axis] = -corner[axis];
    distance =
        std::max(distance, dot(corner, picture.back) + std::max(std::abs(dot(corner, picture.right)) / right,
                                                                std::abs(dot(corner, picture.up)) / up));
  }
  target_ = box.middle;
  distance_ = std::max(distance, box.size);
  keep_within_limits();
}

void Navigation::orbit(double right, double down) {
  if (!all_finite({right, down})) return;
  azimuth_ = std::remainder(azimuth_ - kPi * std::remainder(right, 2), 2 * kPi);
  elevation_ = std::clamp(elevation_ + kPi * down, -kSteepest, kSteepest);
}

void Navigation::pan(double right, double down) {
  if (!all_finite({right, down})) return;
  const Axes picture = axes();
  const double height = 2 * kTangent * distance_;  // of the window, where the target is
  shift(picture.right, -right * height);
  shift(picture.up, down * height);
}

void Navigation::zoom(double steps) {
  scale(std::pow(kZoomStep, -steps));
}

void Navigation::move(double right, double up, double forward) {
  if (!all_finite({right, up, forward})) return;
  const Axes picture = axes();
  const double unit = std::max(distance_, 0.01 * scene_size_);
  shift(picture.right, right * unit);
  shift({0, 1, 0}, up * unit);
  shift(picture.back, -forward * unit);
}

void Navigation::scale(double factor) {
  if (std::isnan(factor) || factor < 0) return;
  // From 0 and infinity the limits lead back.
  distance_ /= factor;
  keep_within_limits();
}

void Navigation::advance(const Motion& motion, double seconds) {
  if (!(seconds > 0)) return;
  const double amount = kSpeed * seconds;
  move(amount * motion.right, amount * motion.up, amount * motion.forward);
  scale(std::pow(kGrowth, motion.scale * seconds));
}

void Navigation::shift(const Vector3& direction, double amount) {
  // More than once across all that may be reached makes no difference, but for infinity times 0.
  const double across = 4 * kFarthest * scene_size_, way = std::clamp(amount, -across, across);
  for (std::size_t axis = 0; axis < 3; ++axis) target_[axis] += way * direction[axis];
  keep_within_limits();
}

void Navigation::keep_within_limits() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double reach = kFarthest * scene_size_;
    target_[axis] = std::clamp(target_[axis], scene_middle_[axis] - reach, scene_middle_[axis] + reach);
  }
  const double nearest = std::max(kNearest * scene_size_, kResolution * greatest_coordinate(target_));
  distance_ = std::clamp(distance_, nearest, std::max(nearest, kFarthest * scene_size_));
}

Navigation::Axes Navigation::axes() const {
  const double east = std::sin(azimuth_), south = std::cos(azimuth_);
  const double high = std::sin(elevation_), flat = std::cos(elevation_);
  return {.right = {south, 0, -east},
          .up = {-high * east, flat, -high * south},
          .back = {flat * east, high, flat * south}};
}

Vector3 Navigation::eye() const {
  const Vector3 back = axes().back;
  return {target_[0] + distance_ * back[0], target_[1] + distance_ * back[1],
          target_[2] + distance_ * back[2]};
}

scene_render::Camera Navigation::camera() const {
  return {.eye = eye(), .target = target_, .tangent = kTangent};
}

}  // namespace scene_analyzer::viewer
