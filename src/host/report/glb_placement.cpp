#include "report/glb_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scene_analyzer::report {
namespace {

using mesh::Vector3;
using Axes = std::array<Vector3, 3>;  // columns of a linear part
using Quaternion = std::array<double, 4>;

constexpr double kRightAngle = 1e-6;  // largest cosine; the analysis takes similarities this far, too
constexpr double kLeastFloat = std::numeric_limits<float>::min();
constexpr double kMostFloat = std::numeric_limits<float>::max();

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double determinant(const Axes& axes) {
  const auto& [a, b, c] = axes;
  return dot(a, {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]});
}

// `axes` are those of a rotation. Of the four ways to the quaternion the one with the largest divisor.
Quaternion rotation_of(const Axes& axes) {
  const auto m = [&](std::size_t row, std::size_t column) { return axes[column][row]; };
  const double xx = m(0, 0), yy = m(1, 1), zz = m(2, 2);
  const double xy = m(1, 0) + m(0, 1), xz = m(0, 2) + m(2, 0), yz = m(2, 1) + m(1, 2);
  const double xw = m(2, 1) - m(1, 2), yw = m(0, 2) - m(2, 0), zw = m(1, 0) - m(0, 1);
  // Four times the products of the quaternion's components: each row is the quaternion times a factor.
  const std::array<Quaternion, 4> products = {{{1 + xx - yy - zz, xy, xz, xw},
                                               {xy, 1 - xx + yy - zz, yz, yw},
                                               {xz, yz, 1 - xx - yy + zz, zw},
                                               {xw, yw, zw, 1 + xx + yy + zz}}};
  std::size_t best = 3;
  for (std::size_t i = 0; i < 3; ++i)
    if (products[i][i] > products[best][best]) best = i;
  Quaternion result = products[best];
  double squares = 0;
  for (const double component : result) squares += component * component;
  const double factor = (result[3] < 0 ? -1 : 1) / std::sqrt(squares);
  for (double& component : result) component *= factor;
  return result;
}

// Makes unit vectors of `axes`. False where they are not at right angles or have no length that a 32-bit
// float can hold.
bool take_scale(Axes& axes, Vector3& scale) {
  for (std::size_t i = 0; i < 3; ++i) {
    scale[i] = std::sqrt(dot(axes[i], axes[i]));
    if (!(scale[i] >= kLeastFloat && scale[i] <= kMostFloat)) return false;
    for (double& coordinate : axes[i]) coordinate /= scale[i];
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kRightAngle)) return false;
  return true;
}

}  // namespace

std::optional<Placement> place(const mesh::Matrix4& world) {
  if (!std::all_of(world.begin(), world.begin() + 12,
                   [](double element) { return std::abs(element) <= kMostFloat; }))
    return std::nullopt;
  Placement result;
  result.translation = {world[3], world[7], world[11]};
  Axes axes;
  for (std::size_t i = 0; i < 3; ++i) axes[i] = {world[i], world[4 + i], world[8 + i]};
  // A mirror image stays one in the node, because that is what turns triangles around.
  const double sign = determinant(axes) < 0 ? -1 : 1;
  if (take_scale(axes, result.scale)) {
    result.scale[0] *= sign;
    for (double& coordinate : axes[0]) coordinate *= sign;
    result.rotation = rotation_of(axes);
    return result;
  }
  result.scale = {sign, sign, sign};
  for (std::size_t i = 0; i < 9; ++i) result.baked[i] = sign * world[i / 3 * 4 + i % 3];
  return result;
}

Placement upright(const std::optional<std::string>& up_axis, const std::optional<double>& unit_scale) {
  constexpr double kHalf = std::numbers::sqrt2 / 2;  // a quarter turn is by twice 45 degrees
  Placement result;
  const std::string axis = up_axis.value_or("+Y");
  if (axis == "+X") result.rotation = {0, 0, kHalf, kHalf};
  if (axis == "-X") result.rotation = {0, 0, -kHalf, kHalf};
  if (axis == "-Y") result.rotation = {1, 0, 0, 0};
  if (axis == "+Z") result.rotation = {-kHalf, 0, 0, kHalf};
  if (axis == "-Z") result.rotation = {kHalf, 0, 0, kHalf};
  if (unit_scale && *unit_scale >= kLeastFloat && *unit_scale <= kMostFloat)
    result.scale = {*unit_scale, *unit_scale, *unit_scale};
  return result;
}

}  // namespace scene_analyzer::report
