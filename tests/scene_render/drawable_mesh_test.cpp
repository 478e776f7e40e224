// Meshes prepared for drawing look like those of the file, and are small.
#include "scene_render/drawable_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "support/scenes.h"

namespace scene_analyzer::scene_render {
namespace {

using test_meshes::TestMesh;

constexpr std::uint64_t kMostBytes = 56;  // per triangle

mesh::TriangleMesh as_mesh(const TestMesh& mesh) {
  mesh::TriangleMesh result;
  result.positions = mesh.positions;
  result.indices = mesh.indices;
  return result;
}

std::uint32_t corner(const DrawableMesh& drawable, std::size_t number) {
  return drawable.indices.empty() ? static_cast<std::uint32_t>(number) : drawable.indices[number];
}

mesh::Vector3 unpack(std::uint32_t normal) {
  mesh::Vector3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = (static_cast<double>(normal >> (10 * axis) & 1023u) - 512) / 511;
  return result;
}

double length(const mesh::Vector3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

bool all_finite(const TestMesh& mesh, std::size_t triangle) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(mesh.positions[3 * mesh.indices[3 * triangle + c] + axis])) return false;
  return true;
}

TEST(DrawableMesh, EveryTriangleOfTheCatalogueIsWhereItWas) {
  for (const TestMesh& mesh : test_meshes::small_catalogue()) {
    const DrawableMesh drawable = make_drawable(as_mesh(mesh), false);
    std::size_t finite = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) finite += all_finite(mesh, t) ? 1 : 0;
    if (finite == 0) {
      EXPECT_EQ(drawable.triangles, 0U) << mesh.name;
      continue;
    }
    ASSERT_EQ(drawable.triangles, mesh.triangle_count()) << mesh.name;
    EXPECT_LE(drawable.bytes(), kMostBytes * drawable.triangles) << mesh.name;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!all_finite(mesh, t)) {
        EXPECT_EQ(corner(drawable, 3 * t), corner(drawable, 3 * t + 1)) << mesh.name << ": has no area";
        continue;
      }
      for (std::size_t i = 3 * t; i < 3 * t + 3; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double drawn = drawable.positions[3 * corner(drawable, i) + axis];
          ASSERT_NEAR(drawn * drawable.radius + drawable.center[axis],
                      mesh.positions[3 * mesh.indices[i] + axis], 1e-7 * drawable.radius)
              << mesh.name;
          ASSERT_LE(std::abs(drawn), 1.0F) << mesh.name;
        }
    }
  }
}

TEST(DrawableMesh, FarFromTheOriginNothingIsLost) {
  const TestMesh near = test_meshes::geosphere(6), far = test_meshes::moved(near, 1 << 20, 0, -(1 << 20));
  const DrawableMesh drawable = make_drawable(as_mesh(far), false);
  EXPECT_NEAR(drawable.radius, 1, 0.1);
  for (std::size_t i = 0; i < far.positions.size(); ++i)
    ASSERT_NEAR(drawable.positions[i] * drawable.radius + drawable.center[i % 3], far.positions[i], 1e-7);
}

TEST(DrawableMesh, SmoothSurfacesHaveNormalsAndSharpOnesHaveNone) {
  for (const bool unwelded : {false, true}) {
    TestMesh sphere = test_meshes::geosphere(12);
    if (unwelded) sphere = test_meshes::unwelded(sphere);
    const DrawableMesh drawable = make_drawable(as_mesh(sphere), false);
    ASSERT_EQ(drawable.normals.size() * 3, drawable.positions.size());
    for (std::size_t v = 0; v < drawable.normals.size(); ++v) {
      const mesh::Vector3 normal = unpack(drawable.normals[v]);
      ASSERT_GT(length(normal), 0.95);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double outward = drawable.positions[3 * v + axis] * drawable.radius + drawable.center[axis];
        ASSERT_NEAR(normal[axis] / length(normal), outward, 0.02) << "away from the middle";
      }
    }
  }
  EXPECT_TRUE(make_drawable(as_mesh(test_meshes::cube()), false).normals.empty());
  EXPECT_TRUE(make_drawable(as_mesh(test_meshes::isolated_soup(100, 1)), false).indices.empty())
      << "nothing is shared";
  EXPECT_FALSE(make_drawable(as_mesh(test_meshes::grid(4, 4)), false).normals.empty());
}

TEST(DrawableMesh, VerticesThatLookTheSameAreStoredOnce) {
  const TestMesh sphere = test_meshes::geosphere(12);
  const DrawableMesh joined = make_drawable(as_mesh(test_meshes::unwelded(sphere)), false);
  EXPECT_EQ(joined.positions.size(), sphere.positions.size());
  EXPECT_EQ(joined.indices.size(), sphere.indices.size());
  const TestMesh zeros = test_meshes::unwelded(test_meshes::signed_zeros());
  EXPECT_EQ(make_drawable(as_mesh(zeros), false).positions.size(), 3U * 4U) << "-0 is 0";
}

TEST(DrawableMesh, TexturePositionsKeepTheirRange) {
  test_meshes::Random random(5);
  const TestMesh shape = test_meshes::unwelded(test_meshes::geosphere(5));
  std::vector<float> coordinates;
  for (std::size_t v = 0; v < shape.vertex_count(); ++v)
    coordinates.insert(coordinates.end(), {static_cast<float>(random.between(-3, 40)), 0.25F});
  coordinates[0] = std::numeric_limits<float>::quiet_NaN();
  mesh::TriangleMesh mesh = as_mesh(shape);
  mesh.texture_coordinates = coordinates;
  const DrawableMesh drawable = make_drawable(mesh, true);
  EXPECT_LE(drawable.bytes(), kMostBytes * drawable.triangles);
  ASSERT_FALSE(drawable.texture_positions.empty());
  for (std::size_t i = 1; i < shape.indices.size(); ++i) {
    const std::uint32_t packed = drawable.texture_positions[corner(drawable, i)];
    EXPECT_NEAR(drawable.texture_low[0] + drawable.texture_range[0] * (packed & 0xffff) / 65535,
                coordinates[2 * i], 43.0 / 65535);
    EXPECT_EQ(drawable.texture_low[1] + drawable.texture_range[1] * (packed >> 16) / 65535, 0.25);
  }
  EXPECT_TRUE(make_drawable(mesh, false).texture_positions.empty());
}

TEST(DrawableMesh, NothingToDrawIsNothing) {
  EXPECT_EQ(make_drawable({}, false).triangles, 0U);
  TestMesh nowhere = test_meshes::single_triangle();
  for (float& number : nowhere.positions) number = std::numeric_limits<float>::infinity();
  EXPECT_EQ(make_drawable(as_mesh(nowhere), false).triangles, 0U);
  TestMesh point = test_meshes::single_triangle();
  for (float& number : point.positions) number = 7;
  EXPECT_EQ(make_drawable(as_mesh(point), false).positions[0], 0.0F) << "the radius is not 0";
}

TEST(FirstOfEqual, AgreesWithAMap) {
  test_meshes::Random random(1);
  for (const std::size_t count : {0, 1, 2, 1000, 20000}) {
    std::vector<std::array<std::uint32_t, 3>> triples(count);
    for (auto& triple : triples)
      for (std::uint32_t& word : triple) word = static_cast<std::uint32_t>(random.below(20));
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> seen;
    const std::vector<std::uint32_t> first = first_of_equal(triples);
    ASSERT_EQ(first.size(), count);
    for (std::uint32_t i = 0; i < count; ++i)
      ASSERT_EQ(first[i], seen.try_emplace(triples[i], i).first->second);
  }
}

}  // namespace
}  // namespace scene_analyzer::scene_render
