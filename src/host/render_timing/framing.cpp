#include "render_timing/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace scene_analyzer::render_timing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

mesh::Vector3 position_of(const TimedMesh& mesh, std::uint32_t vertex) {
  const auto p = mesh.positions.subspan(std::size_t{3} * vertex, 3);
  const mesh::Matrix3& a = mesh.linear;
  if (a == mesh::kIdentity3) return {p[0], p[1], p[2]};
  mesh::Vector3 moved;
  for (std::size_t row = 0; row < 3; ++row)
    moved[row] = a[3 * row] * p[0] + a[3 * row + 1] * p[1] + a[3 * row + 2] * p[2];
  return moved;
}

std::vector<std::uint32_t> drawn_indices(const TimedMesh& mesh) {
  std::vector<std::uint32_t> drawn;
  drawn.reserve(mesh.indices.size() - 3 * mesh.left_out.size());
  auto skipped = mesh.left_out.begin();
  for (std::size_t triangle = 0; 3 * triangle < mesh.indices.size(); ++triangle) {
    if (skipped != mesh.left_out.end() && *skipped == triangle) {
      ++skipped;
      continue;
    }
    const auto corners = mesh.indices.subspan(3 * triangle, 3);
    drawn.insert(drawn.end(), corners.begin(), corners.end());
  }
  return drawn;
}

mesh::Vector3 middle_of(const TimedMesh& mesh, const std::vector<std::uint32_t>& drawn) {
  mesh::Vector3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const std::uint32_t vertex : drawn) {
    const mesh::Vector3 p = position_of(mesh, vertex);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return {std::midpoint(low[0], high[0]), std::midpoint(low[1], high[1]), std::midpoint(low[2], high[2])};
}

}  // namespace

FramedMesh frame(const TimedMesh& mesh) {
  FramedMesh framed{.positions = std::vector<float>(mesh.positions.size(), 0),
                    .indices = drawn_indices(mesh)};
  const mesh::Vector3 middle = middle_of(mesh, framed.indices);
  double radius = 0;
  for (const std::uint32_t vertex : framed.indices) {
    const mesh::Vector3 p = position_of(mesh, vertex);
    radius = std::max(radius, std::hypot(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]));
  }
  for (const std::uint32_t vertex : framed.indices) {
    const mesh::Vector3 p = position_of(mesh, vertex);
    for (std::size_t axis = 0; axis < 3; ++axis)
      framed.positions[std::size_t{3} * vertex + axis] =
          static_cast<float>((p[axis] - middle[axis]) / radius);
  }
  return framed;
}

std::array<float, 9> rotation(std::uint32_t index, std::uint32_t steps) {
  const std::uint32_t row = index / steps, column = index % steps;
  const double about_x = 2 * std::numbers::pi * row / steps;
  const double about_y = 2 * std::numbers::pi * column / steps;
  const double cx = std::cos(about_x), sx = std::sin(about_x), cy = std::cos(about_y), sy = std::sin(about_y);
  const double product[9] = {cy, sy * sx, sy * cx, 0, cx, -sx, -sy, cy * sx, cy * cx};
  std::array<float, 9> result;
  std::ranges::transform(product, result.begin(), [](double entry) { return static_cast<float>(entry); });
  return result;
}

std::vector<std::uint32_t> spread_rotations(std::uint32_t count, std::uint32_t all) {
  // Steps of about the golden section leave no direction out for long; coprime to `all` they repeat none.
  auto step = static_cast<std::uint32_t>(0.6180339887 * all);
  while (std::gcd(step, all) != 1) ++step;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < count; ++i)
    chosen.push_back(static_cast<std::uint32_t>(std::uint64_t{i} * step % all));
  return chosen;
}

}  // namespace scene_analyzer::render_timing
