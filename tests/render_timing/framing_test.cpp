// How a mesh stands before the eye, from where it is seen, and which meshes share the device.
#include "render_timing/framing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "render_timing/mesh_group.h"
#include "support/meshes.h"

namespace scene_analyzer::render_timing {
namespace {

using testing::ElementsAre;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double radius_of(const FramedMesh& mesh) {
  double radius = 0;
  for (const std::uint32_t v : mesh.indices)
    radius = std::max(radius, std::hypot(double{mesh.positions[3 * v]}, double{mesh.positions[3 * v + 1]},
                                         double{mesh.positions[3 * v + 2]}));
  return radius;
}

TEST(Frame, TheBoundingSphereIsTheUnitSphere) {
  for (const auto& mesh : {test_meshes::cube(), test_meshes::geosphere(5), test_meshes::torus(9, 7),
                           test_meshes::heightfield(8, 0.5, 3)}) {
    const FramedMesh framed = frame({.positions = mesh.positions, .indices = mesh.indices});
    EXPECT_EQ(framed.indices, mesh.indices);
    EXPECT_EQ(framed.positions.size(), mesh.positions.size());
    EXPECT_NEAR(radius_of(framed), 1, 1e-6) << mesh.name;
  }
}

TEST(Frame, WhatIsNotDrawnDoesNotCount) {
  // A unit square around (100, 200, 300), a far triangle that is left out, vertices that nothing uses.
  const std::vector<float> positions = {kNan, 0,   0,   99, 199, 300, 101,   199, 300,
                                        101,  201, 300, 99, 201, 300, 1e30F, 0,   0};
  const std::vector<std::uint32_t> indices = {1, 2, 3, 5, 5, 1, 1, 3, 4, 0, 1, 2}, left_out = {1, 3};
  const FramedMesh framed = frame({.positions = positions, .indices = indices, .left_out = left_out});
  EXPECT_THAT(framed.indices, ElementsAre(1, 2, 3, 1, 3, 4));
  EXPECT_THAT(framed.positions, testing::Each(testing::Truly([](float x) { return std::abs(x) <= 1; })));
  EXPECT_FLOAT_EQ(framed.positions[3], -std::sqrt(0.5F));
  EXPECT_FLOAT_EQ(framed.positions[10], std::sqrt(0.5F));
  EXPECT_EQ(framed.positions[5], 0);
}

TEST(Frame, LinearPartsAreApplied) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> indices = {0, 1, 2};
  const FramedMesh framed =
      frame({.positions = positions, .indices = indices, .linear = {0, 0, 0, 4, 0, 0, 0, 3, 0}});
  // (0,0,0), (0,4,0), (0,0,3): the middle is (0, 2, 1.5) and the radius 2.5.
  EXPECT_THAT(framed.positions,
              ElementsAre(0, testing::FloatEq(-0.8F), testing::FloatEq(-0.6F), 0, testing::FloatEq(0.8F),
                          testing::FloatEq(-0.6F), 0, testing::FloatEq(-0.8F), testing::FloatEq(0.6F)));
}

std::array<float, 3> turned(const std::array<float, 9>& by, const std::array<float, 3>& v) {
  std::array<float, 3> result{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) result[row] += by[3 * row + column] * v[column];
  return result;
}

TEST(Rotation, TurnsAboutXAndThenAboutY) {
  const auto near = [](float value) { return testing::FloatNear(value, 1e-6F); };
  EXPECT_THAT(rotation(0, 4), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(turned(rotation(1, 4), {0, 0, 1}), ElementsAre(near(1), near(0), near(0)));  // about y
  EXPECT_THAT(turned(rotation(4, 4), {0, 1, 0}), ElementsAre(near(0), near(0), near(1)));  // about x
  EXPECT_THAT(turned(rotation(5, 4), {0, 1, 0}), ElementsAre(near(1), near(0), near(0)));  // x first
  EXPECT_THAT(rotation(0, 1), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
}

TEST(SpreadRotations, RepeatNoneAndLeaveNoAxisOut) {
  for (const std::uint32_t steps : {1U, 2U, 3U, 4U, 8U, 12U, 256U}) {
    const std::uint32_t all = steps * steps;
    std::vector<std::uint32_t> every = spread_rotations(all, all), expected(all);
    std::ranges::sort(every);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(every, expected) << steps;
    std::set<std::uint32_t> rows, columns;
    for (const std::uint32_t index : spread_rotations(std::min(all, 2 * steps), all)) {
      rows.insert(index / steps);
      columns.insert(index % steps);
    }
    EXPECT_GE(2 * rows.size(), steps) << steps;
    EXPECT_GE(2 * columns.size(), steps) << steps;
  }
}

TEST(GroupMeshes, AsManyTogetherAsFit) {
  gpu::DeviceInfo device;
  device.max_allocation_bytes = 1 << 20;
  device.free_memory_bytes = 10'000;
  const std::vector<float> positions(300);           // 1200 bytes
  const std::vector<std::uint32_t> indices(300, 0);  // 1200 bytes
  const std::vector<std::uint32_t> many(3000, 0);    // 12000 bytes
  const TimedMesh small{.positions = positions, .indices = indices},
      large{.positions = positions, .indices = many};
  const auto ends = [&](const std::vector<TimedMesh>& meshes) {
    std::vector<std::size_t> result;
    std::size_t begin = 0;
    for (const GroupRange& group : group_meshes(meshes, device)) {
      EXPECT_EQ(group.first, begin);
      result.push_back(begin = group.end);
    }
    return result;
  };
  EXPECT_THAT(ends({}), ElementsAre());
  EXPECT_THAT(ends({small, small, small}), ElementsAre(2, 3));  // half of the free memory: 5000 bytes
  EXPECT_THAT(ends({large, small, small, large}), ElementsAre(1, 3, 4));
  device.free_memory_bytes = 1 << 20;
  EXPECT_THAT(ends({large, small, small, large}), ElementsAre(4));
  device.max_allocation_bytes = 13'500;
  EXPECT_THAT(ends({large, small, small, large}), ElementsAre(2, 4));
}

}  // namespace
}  // namespace scene_analyzer::render_timing
