#include "support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace scene_analyzer::test_meshes {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
using Point = std::array<double, 3>;

std::string named(const char* kind, std::size_t number) {
  return std::string(kind) + " " + std::to_string(number);
}

Point point(const TestMesh& mesh, std::uint32_t vertex) {
  const float* p = &mesh.positions[3 * std::size_t{vertex}];
  return {p[0], p[1], p[2]};
}

// The weighted mean, `lift` times as far from the origin.
std::uint32_t add_mean(TestMesh& mesh, const std::vector<std::uint32_t>& corners, double lift = 1) {
  Point sum{};
  for (const std::uint32_t corner : corners)
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] += point(mesh, corner)[axis] * lift / static_cast<double>(corners.size());
  return mesh.vertex(sum[0], sum[1], sum[2]);
}

// Puts `middle` into the triangle: three instead of one.
void split_at(TestMesh& mesh, std::size_t triangle, std::uint32_t middle) {
  std::uint32_t* corner = &mesh.indices[3 * triangle];
  const std::array<std::uint32_t, 3> old = {corner[0], corner[1], corner[2]};
  corner[2] = middle;
  mesh.triangle(old[1], old[2], middle);
  mesh.triangle(old[2], old[0], middle);
}

// Quads between points known by index(u, v), u <= around, v <= across.
template <typename Index>
void add_quads(TestMesh& mesh, std::uint32_t around, std::uint32_t across, Index index) {
  for (std::uint32_t u = 0; u < around; ++u)
    for (std::uint32_t v = 0; v < across; ++v)
      mesh.quad(index(u, v), index(u + 1, v), index(u + 1, v + 1), index(u, v + 1));
}

std::array<Point, 12> icosahedron_points() {
  const double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}}};
}

constexpr std::array<std::array<std::uint32_t, 3>, 20> kIcosahedron = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// Vertices of the subdivided icosahedron, shared between faces: known by the corners that weigh in and their
// weights.
class GeosphereVertices {
 public:
  explicit GeosphereVertices(TestMesh& mesh) : mesh_(mesh) {}

  std::uint32_t at(const std::array<std::uint32_t, 3>& face, const std::array<std::uint32_t, 3>& weights) {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3> parts;
    for (std::size_t i = 0; i < 3; ++i) parts[i] = {weights[i] > 0 ? face[i] : 0, weights[i]};
    std::sort(parts.begin(), parts.end());
    std::uint64_t key = 0;
    for (const auto& [corner, weight] : parts) key = (key << 16) | (corner << 12) | weight;
    const auto [entry, is_new] = known_.try_emplace(key, 0);
    if (is_new) entry->second = add(parts);
    return entry->second;
  }

 private:
  std::uint32_t add(const std::array<std::pair<std::uint32_t, std::uint32_t>, 3>& parts) {
    Point p{};
    for (const auto& [corner, weight] : parts)
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += weight * corners_[corner][axis];
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return mesh_.vertex(p[0] / length, p[1] / length, p[2] / length);
  }

  TestMesh& mesh_;
  std::array<Point, 12> corners_ = icosahedron_points();
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

// Bends the edge from corner 0 to corner 1 of `triangle` (whose other side is `partner`) outwards in the
// triangle's own plane and splits both sides there: the triangle's halves stay coplanar, the partner's do
// not.
void split_edge_in_plane(TestMesh& mesh, std::size_t triangle) {
  const std::array<std::uint32_t, 3> t = {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1],
                                          mesh.indices[3 * triangle + 2]};
  Point p{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    p[axis] = 0.55 * (point(mesh, t[0])[axis] + point(mesh, t[1])[axis]) - 0.1 * point(mesh, t[2])[axis];
  for (std::size_t other = 0; other < mesh.triangle_count(); ++other)
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t* corner = &mesh.indices[3 * other];
      const std::uint32_t from = corner[c], to = corner[(c + 1) % 3], apex = corner[(c + 2) % 3];
      if (from != t[1] || to != t[0]) continue;
      const std::uint32_t middle = mesh.vertex(p[0], p[1], p[2]);
      mesh.indices[3 * other + (c + 1) % 3] = middle;
      mesh.triangle(middle, t[0], apex);
      mesh.indices[3 * triangle + 1] = middle;
      mesh.triangle(middle, t[1], t[2]);
      return;
    }
}

}  // namespace

std::uint32_t TestMesh::vertex(double x, double y, double z) {
  for (const double coordinate : {x, y, z}) positions.push_back(static_cast<float>(coordinate));
  return static_cast<std::uint32_t>(vertex_count() - 1);
}

void TestMesh::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

void TestMesh::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

TestMesh single_triangle() {
  return {"single triangle", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
}

TestMesh two_triangles(double fold_degrees) {
  TestMesh mesh{named("two triangles folded", static_cast<std::size_t>(fold_degrees * 1000)),
                {0, 0, 0, 1, 0, 0, 0, 1, 0},
                {0, 1, 2}};
  const double fold = fold_degrees * kTurn / 360;
  mesh.vertex(0.3, -std::cos(fold), std::sin(fold));
  mesh.triangle(1, 0, 3);
  return mesh;
}

TestMesh cube() {
  TestMesh mesh{"cube", {}, {}};
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    mesh.vertex(corner & 1U, (corner >> 1U) & 1U, corner >> 2U);
  mesh.quad(0, 2, 3, 1);
  mesh.quad(4, 5, 7, 6);
  mesh.quad(0, 1, 5, 4);
  mesh.quad(2, 6, 7, 3);
  mesh.quad(0, 4, 6, 2);
  mesh.quad(1, 3, 7, 5);
  return mesh;
}

TestMesh split_tetrahedron(int rounds) {
  TestMesh mesh{
      named("tetrahedron split", static_cast<std::size_t>(rounds)), {0, 0, 0, 4, 0, 0, 1, 3, 0, 1, 1, 5}, {}};
  mesh.triangle(0, 1, 3);
  mesh.triangle(1, 2, 3);
  mesh.triangle(2, 0, 3);
  mesh.triangle(0, 2, 1);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t triangle = 3, count = mesh.triangle_count(); triangle < count; ++triangle) {
      const std::uint32_t* corner = &mesh.indices[3 * triangle];
      split_at(mesh, triangle, add_mean(mesh, {corner[0], corner[1], corner[2]}));
    }
  return mesh;
}

TestMesh geosphere(std::uint32_t frequency) {
  TestMesh mesh{named("geosphere", frequency), {}, {}};
  GeosphereVertices vertices(mesh);
  for (const std::array<std::uint32_t, 3>& face : kIcosahedron)
    for (std::uint32_t i = 0; i < frequency; ++i)
      for (std::uint32_t j = 0; i + j < frequency; ++j) {
        const auto at = [&](std::uint32_t a, std::uint32_t b) {
          return vertices.at(face, {frequency - a - b, a, b});
        };
        mesh.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 2 <= frequency) mesh.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  return mesh;
}

TestMesh split_geosphere(int flat, int half, int raised) {
  TestMesh mesh = geosphere(20);
  std::size_t triangle = 190;  // one after the other far from its predecessor
  for (int i = 0; i < flat + half + raised; ++i, triangle += 200) {
    const std::uint32_t* corner = &mesh.indices[3 * triangle];
    if (i < flat)
      split_at(mesh, triangle, add_mean(mesh, {corner[0], corner[1], corner[2]}));
    else if (i < flat + half)
      split_edge_in_plane(mesh, triangle);
    else
      split_at(mesh, triangle, add_mean(mesh, {corner[0], corner[1], corner[2]}, 1.005));
  }
  mesh.name = named("geosphere", mesh.triangle_count());
  return mesh;
}

TestMesh geosphere_8006() {
  return split_geosphere(2, 0, 1);
}
TestMesh geosphere_8010() {
  return split_geosphere(2, 1, 2);
}

TestMesh prism(std::uint32_t sides, std::uint32_t layers, double radius, double height, bool caps) {
  TestMesh mesh{named("prism", sides) + named(" x", layers) + (caps ? " capped" : " open") + " radius " +
                    std::to_string(radius) + " height " + std::to_string(height),
                {},
                {}};
  for (std::uint32_t layer = 0; layer <= layers; ++layer)
    for (std::uint32_t side = 0; side < sides; ++side)
      mesh.vertex(radius * std::cos(kTurn * side / sides), radius * std::sin(kTurn * side / sides),
                  height * layer / layers);
  const auto ring = [&](std::uint32_t side, std::uint32_t layer) { return layer * sides + side % sides; };
  add_quads(mesh, sides, layers, ring);
  if (!caps) return mesh;
  const std::uint32_t bottom = mesh.vertex(0, 0, 0);
  const std::uint32_t top = mesh.vertex(0, 0, height);
  for (std::uint32_t side = 0; side < sides; ++side) {
    mesh.triangle(bottom, ring(side + 1, 0), ring(side, 0));
    mesh.triangle(top, ring(side, layers), ring(side + 1, layers));
  }
  return mesh;
}

TestMesh four_sided_tube(int split_per_side) {
  constexpr double kFraction = 0.2171605;  // of a triangle's edge at the rim, and so of its area
  TestMesh mesh{named("four-sided tube split", static_cast<std::size_t>(split_per_side)), {}, {}};
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    mesh.vertex(5 * std::cos(kTurn * corner / 4), 5 * std::sin(kTurn * corner / 4), corner < 4 ? 0 : 10);
  // A new vertex on the rim near `near`, on the way to `far`: `near` is where the triangle of the next side
  // joins.
  const auto rim = [&](std::uint32_t near, std::uint32_t far) {
    const Point a = point(mesh, near), b = point(mesh, far);
    return mesh.vertex(a[0] + kFraction * (b[0] - a[0]), a[1] + kFraction * (b[1] - a[1]), a[2]);
  };
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::uint32_t left = side, right = (side + 1) % 4, top_left = left + 4, top_right = right + 4;
    if (split_per_side > 0) {
      const std::uint32_t p = rim(left, right);
      mesh.triangle(left, p, top_left);
      mesh.triangle(p, right, top_left);
    } else {
      mesh.triangle(left, right, top_left);
    }
    if (split_per_side > 1) {
      const std::uint32_t q = rim(top_left, top_right);
      mesh.triangle(top_left, right, q);
      mesh.triangle(q, right, top_right);
    } else {
      mesh.triangle(top_left, right, top_right);
    }
  }
  return mesh;
}

TestMesh grid(std::uint32_t columns, std::uint32_t rows, double cell) {
  TestMesh mesh{named("grid", columns) + named(" x", rows), {}, {}};
  for (std::uint32_t y = 0; y <= rows; ++y)
    for (std::uint32_t x = 0; x <= columns; ++x) mesh.vertex(x * cell, y * cell, 0);
  add_quads(mesh, columns, rows, [&](std::uint32_t x, std::uint32_t y) { return y * (columns + 1) + x; });
  return mesh;
}

TestMesh heightfield(std::uint32_t side, double roughness, std::uint64_t seed) {
  TestMesh mesh = grid(side, side);
  mesh.name = named("heightfield", side) + named(" seed", seed) + " roughness " + std::to_string(roughness);
  Random random(seed);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions[3 * v + 2] = static_cast<float>(roughness * random.unit());
  return mesh;
}

TestMesh torus(std::uint32_t around, std::uint32_t across) {
  TestMesh mesh{named("torus", around) + named(" x", across), {}, {}};
  for (std::uint32_t u = 0; u < around; ++u)
    for (std::uint32_t v = 0; v < across; ++v) {
      const double radius = 3 + std::cos(kTurn * v / across);
      mesh.vertex(radius * std::cos(kTurn * u / around), radius * std::sin(kTurn * u / around),
                  std::sin(kTurn * v / across));
    }
  add_quads(mesh, around, across,
            [&](std::uint32_t u, std::uint32_t v) { return (u % around) * across + v % across; });
  return mesh;
}

TestMesh mobius_strip(std::uint32_t segments) {
  TestMesh mesh{named("mobius strip", segments), {}, {}};
  for (std::uint32_t u = 0; u < segments; ++u)
    for (const double width : {-0.4, 0.4}) {
      const double turn = kTurn * u / segments;
      const double radius = 1 + width * std::cos(turn / 2);
      mesh.vertex(radius * std::cos(turn), radius * std::sin(turn), width * std::sin(turn / 2));
    }
  add_quads(mesh, segments, 1,
            [&](std::uint32_t u, std::uint32_t v) { return u < segments ? 2 * u + v : 1 - v; });
  return mesh;
}

TestMesh klein_bottle(std::uint32_t around, std::uint32_t across) {
  TestMesh mesh{named("klein bottle", around) + named(" x", across), {}, {}};
  for (std::uint32_t u = 0; u < around; ++u)
    for (std::uint32_t v = 0; v < across;
         ++v) {  // figure-eight immersion: half a turn of the eight per turn of the bottle
      const double turn = kTurn * u / around, eight = kTurn * v / across;
      const double radius =
          3 + std::cos(turn / 2) * std::sin(eight) - std::sin(turn / 2) * std::sin(2 * eight);
      mesh.vertex(radius * std::cos(turn), radius * std::sin(turn),
                  std::sin(turn / 2) * std::sin(eight) + std::cos(turn / 2) * std::sin(2 * eight));
    }
  add_quads(mesh, around, across, [&](std::uint32_t u, std::uint32_t v) {
    return u < around ? u * across + v % across : (across - v) % across;
  });
  return mesh;
}

TestMesh cone_fan(std::uint32_t valence) {
  TestMesh mesh{named("cone fan", valence), {0, 0, 1}, {}};
  for (std::uint32_t i = 0; i < valence; ++i)
    mesh.vertex(std::cos(kTurn * i / valence), std::sin(kTurn * i / valence), 0);
  for (std::uint32_t i = 0; i < valence; ++i) mesh.triangle(0, 1 + i, 1 + (i + 1) % valence);
  return mesh;
}

}  // namespace scene_analyzer::test_meshes
