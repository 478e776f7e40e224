#include "report/glb_placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace scene_analyzer::report {
namespace {

using mesh::Matrix4;
using mesh::Vector3;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Vector3 baked(const Placement& placement, const Vector3& p) {
  Vector3 result{};
  for (std::size_t i = 0; i < 9; ++i) result[i / 3] += placement.baked[i] * p[i % 3];
  return result;
}

// As glTF defines it: q p q* of the scaled point, then the translation.
Vector3 placed(const Placement& placement, const Vector3& local) {
  const Vector3 b = baked(placement, local);
  const Vector3 p = {b[0] * placement.scale[0], b[1] * placement.scale[1], b[2] * placement.scale[2]};
  const auto [x, y, z, w] = placement.rotation;
  const auto cross = [&](const Vector3& v) {
    return Vector3{y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]};
  };
  const Vector3 once = cross(p), twice = cross(once);
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = placement.translation[i] + p[i] + 2 * (w * once[i] + twice[i]);
  return result;
}

Vector3 transformed(const Matrix4& m, const Vector3& p) {
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3];
  return result;
}

double linear_determinant(const mesh::Matrix3& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

// Axes of any directions and lengths: columns of a rotation times `scale`.
Matrix4 turned(std::mt19937& random, const Vector3& scale) {
  std::normal_distribution<double> normal;
  Placement placement;
  double squares = 0;
  for (double& component : placement.rotation) squares += std::pow(component = normal(random), 2);
  for (double& component : placement.rotation) component /= std::sqrt(squares);
  Matrix4 result = mesh::kIdentity4;
  for (std::size_t column = 0; column < 3; ++column) {
    Vector3 axis{};
    axis[column] = scale[column];
    const Vector3 image = placed(placement, axis);
    for (std::size_t row = 0; row < 3; ++row) result[4 * row + column] = image[row];
  }
  for (const std::size_t i : {3u, 7u, 11u}) result[i] = 10 * normal(random);
  return result;
}

// `placement` does what `world` does, up to `tolerance` relative to the largest element.
void expect_same(const Placement& placement, const Matrix4& world, double tolerance) {
  double size = 0;
  for (const double element : world) size = std::max(size, std::abs(element));
  for (const Vector3& point : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}, Vector3{-1, 2, 3}}) {
    const Vector3 is = placed(placement, point), wanted = transformed(world, point);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], wanted[i], tolerance * size);
  }
}

TEST(GlbPlacement, TakesRotationsAndScalesApart) {
  std::mt19937 random(3);
  for (const Vector3& scale :
       {Vector3{1, 1, 1}, Vector3{2, 3, 4}, Vector3{1e-3, 1, 1e3}, Vector3{1e-20, 1e-20, 1e-20},
        Vector3{-1, 1, 1}, Vector3{1, -2, 1}, Vector3{-3, -3, -3}})
    for (int i = 0; i < 200; ++i) {
      const Matrix4 world = turned(random, scale);
      const auto placement = place(world);
      ASSERT_TRUE(placement);
      EXPECT_EQ(placement->baked, mesh::kIdentity3);
      EXPECT_GE(placement->rotation[3], 0);
      double squares = 0;
      for (const double component : placement->rotation) squares += component * component;
      EXPECT_NEAR(squares, 1, 1e-14);
      expect_same(*placement, world, 1e-13);
    }
}

TEST(GlbPlacement, HalfTurnsAreRotations) {
  // Their quaternions have w = 0, where the usual formula divides by nothing.
  for (const Vector3& diagonal : {Vector3{1, -1, -1}, Vector3{-1, 1, -1}, Vector3{-1, -1, 1}}) {
    Matrix4 world = mesh::kIdentity4;
    for (std::size_t i = 0; i < 3; ++i) world[5 * i] = diagonal[i];
    const auto placement = place(world);
    ASSERT_TRUE(placement);
    EXPECT_EQ(placement->scale, (Vector3{1, 1, 1}));
    expect_same(*placement, world, 0);
  }
}

TEST(GlbPlacement, NothingIsNothing) {
  const auto placement = place(mesh::kIdentity4);
  ASSERT_TRUE(placement);
  const Placement none;
  EXPECT_EQ(placement->translation, none.translation);
  EXPECT_EQ(placement->rotation, none.rotation);
  EXPECT_EQ(placement->scale, none.scale);
  EXPECT_EQ(placement->baked, none.baked);
}

TEST(GlbPlacement, BakesWhatIsNeither) {
  const Matrix4 shear = {1, 0.5, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1};
  const Matrix4 mirrored = {-1, 0.5, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1};
  const Matrix4 flat = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Matrix4 point = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 1};
  const Matrix4 tiny = {1e-200, 0, 0, 1, 0, 1e-200, 0, 2, 0, 0, 1e-200, 3, 0, 0, 0, 1};
  // Right angles, but a length that is subnormal in floats.
  const Matrix4 short_axis = {1, 0, 0, 0, 0, 1e-40, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (const Matrix4& world : {shear, mirrored, flat, point, tiny, short_axis}) {
    const auto placement = place(world);
    ASSERT_TRUE(placement);
    EXPECT_NE(placement->baked, mesh::kIdentity3);
    EXPECT_GE(linear_determinant(placement->baked), 0) << "triangles would be turned around";
    expect_same(*placement, world, 1e-15);
  }
  EXPECT_EQ(place(mirrored)->scale, (Vector3{-1, -1, -1}));
  EXPECT_EQ(place(shear)->scale, (Vector3{1, 1, 1}));
}

TEST(GlbPlacement, AlmostRightAnglesAreRight) {
  Matrix4 world = mesh::kIdentity4;
  world[1] = 0.9e-6;
  EXPECT_EQ(place(world)->baked, mesh::kIdentity3);
  expect_same(*place(world), world, 2e-6);
  world[1] = 1.1e-6;
  EXPECT_NE(place(world)->baked, mesh::kIdentity3);
}

TEST(GlbPlacement, RefusesWhatNoFloatHolds) {
  for (const double element : {kNan, std::numeric_limits<double>::infinity(), -1e39})
    for (std::size_t i = 0; i < 12; ++i) {
      Matrix4 world = mesh::kIdentity4;
      world[i] = element;
      EXPECT_FALSE(place(world)) << element << " in element " << i;
    }
}

TEST(GlbPlacement, TakesTheLastRowForGranted) {
  Matrix4 world = mesh::kIdentity4;
  world[12] = 3, world[15] = kNan;
  const auto placement = place(world);
  ASSERT_TRUE(placement);
  expect_same(*placement, mesh::kIdentity4, 0);
}

TEST(GlbPlacement, SetsEveryAxisUpright) {
  const std::pair<const char*, Vector3> axes[] = {{"+X", {1, 0, 0}},  {"-X", {-1, 0, 0}}, {"+Y", {0, 1, 0}},
                                                  {"-Y", {0, -1, 0}}, {"+Z", {0, 0, 1}},  {"-Z", {0, 0, -1}}};
  for (const auto& [name, up] : axes) {
    const Vector3 image = placed(upright(name, 0.5), up);
    EXPECT_NEAR(image[0], 0, 1e-15) << name;
    EXPECT_NEAR(image[1], 0.5, 1e-15) << name;
    EXPECT_NEAR(image[2], 0, 1e-15) << name;
  }
  // FBX files that are +Z up look along -Y, glTF's front is +Z.
  EXPECT_NEAR(placed(upright("+Z", 1), {0, -1, 0})[2], 1, 1e-15);
}

TEST(GlbPlacement, StatesNothingWhereNothingIsStated) {
  const Placement none;
  for (const std::optional<double>& scale : {std::optional<double>(), std::optional(0.0), std::optional(-1.0),
                                             std::optional(kNan), std::optional(1e300)}) {
    EXPECT_EQ(upright(std::nullopt, scale).scale, none.scale);
    EXPECT_EQ(upright("sideways", scale).rotation, none.rotation);
  }
}

}  // namespace
}  // namespace scene_analyzer::report
