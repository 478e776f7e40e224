#include <cmath>
#include <limits>
#include <numbers>

#include "support/meshes.h"

namespace scene_analyzer::test_meshes {

TestMesh book(std::uint32_t pages, std::uint64_t seed, std::uint32_t planes) {
  TestMesh mesh{"book of " + std::to_string(pages) + " pages in " + std::to_string(planes) + " planes",
                {0, 0, 0, 0, 0, 1},
                {}};
  Random random(seed);
  for (std::uint32_t page = 0; page < pages; ++page) {
    const double part = planes > 0 ? static_cast<double>(random.below(planes)) / planes : random.unit();
    const double turn = 2 * std::numbers::pi * part, radius = random.between(1, 2);
    const std::uint32_t apex = mesh.vertex(radius * std::cos(turn), radius * std::sin(turn), random.unit());
    if (random.below(2) == 0)
      mesh.triangle(0, 1, apex);
    else
      mesh.triangle(1, 0, apex);
  }
  return mesh;
}

TestMesh isolated_soup(std::uint32_t triangles, std::uint64_t seed) {
  TestMesh mesh{"isolated soup " + std::to_string(triangles), {}, {}};
  Random random(seed);
  for (std::uint32_t v = 0; v < 3 * triangles; ++v)
    mesh.indices.push_back(mesh.vertex(random.unit(), random.unit(), random.unit()));
  return mesh;
}

TestMesh indexed_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint64_t seed) {
  TestMesh mesh{
      "indexed soup " + std::to_string(vertices) + " vertices " + std::to_string(triangles) + " triangles",
      {},
      {}};
  Random random(seed);
  for (std::uint32_t v = 0; v < vertices; ++v) mesh.vertex(random.unit(), random.unit(), random.unit());
  for (std::uint32_t i = 0; i < 3 * triangles; ++i)
    mesh.indices.push_back(static_cast<std::uint32_t>(random.below(vertices)));
  return mesh;
}

TestMesh lattice_soup(std::uint32_t side, std::uint32_t triangles, std::uint64_t seed) {
  TestMesh mesh{
      "lattice soup " + std::to_string(side) + " side " + std::to_string(triangles) + " triangles", {}, {}};
  Random random(seed);
  const auto coordinate = [&] { return static_cast<double>(random.below(side)); };
  for (std::uint32_t i = 0; i < 3 * triangles; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    mesh.indices.push_back(mesh.vertex(x, y, z));
  }
  return mesh;
}

TestMesh non_finite(std::uint64_t seed) {
  TestMesh mesh = heightfield(24, 1, seed);
  mesh.name = "non-finite coordinates";
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float values[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity};
  Random random(seed);
  for (int i = 0; i < 60; ++i) mesh.positions[random.below(mesh.positions.size())] = values[i % 3];
  return mesh;
}

TestMesh all_degenerate() {
  TestMesh mesh{"all degenerate", {}, {}};
  for (int v = 0; v < 8; ++v) mesh.vertex(v, 2 * v, -v);  // collinear
  mesh.vertex(0, 0, 0);                                   // a second vertex 0
  mesh.vertex(5, 0, 0);
  mesh.vertex(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  for (std::uint32_t v = 0; v + 2 < 8; ++v) mesh.triangle(v, v + 1, v + 2);
  mesh.triangle(0, 8, 9);
  mesh.triangle(3, 3, 9);
  mesh.triangle(1, 10, 9);
  mesh.triangle(10, 10, 10);
  return mesh;
}

TestMesh slivers(std::uint32_t count, std::uint64_t seed) {
  TestMesh mesh{"slivers " + std::to_string(count), {}, {}};
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double length = random.between(0.5, 2), height = length * 1e-6 * random.between(0.2, 5);
    const std::uint32_t a = mesh.vertex(0, 0, i), b = mesh.vertex(length, 0, i);
    const std::uint32_t c = mesh.vertex(length * random.unit(), height, i),
                        d = mesh.vertex(length * random.unit(), -height, i);
    mesh.triangle(a, b, c);
    mesh.triangle(b, a, d);
  }
  return mesh;
}

TestMesh signed_zeros() {
  return {"signed zeros",
          {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, -0.0F, 0.0F, -0.0F, 1.0F, -0.0F, 0.0F, 0.5F,
           -1.0F, -0.0F},
          {0, 1, 2, 4, 3, 5}};
}

TestMesh nearly_equal_areas(std::uint32_t triangles, std::uint64_t seed) {
  TestMesh mesh{"nearly equal areas " + std::to_string(triangles), {}, {}};
  Random random(seed);
  for (std::uint32_t i = 0; i <= triangles; i += 2) {
    mesh.vertex(i / 2, 0, 0);
    mesh.vertex(i / 2, 1 + 0x1p-23 * static_cast<double>(random.below(200)), 0);
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint32_t left = i / 2 * 2;
    if (left + 3 >= mesh.vertex_count()) break;
    if (i % 2 == 0)
      mesh.triangle(left, left + 2, left + 1);
    else
      mesh.triangle(left + 1, left + 2, left + 3);
  }
  return mesh;
}

}  // namespace scene_analyzer::test_meshes
