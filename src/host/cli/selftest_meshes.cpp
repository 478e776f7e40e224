#include "cli/selftest_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace scene_analyzer::cli {

std::uint32_t BuiltInMesh::add_vertex(double x, double y, double z) {
  const auto index = static_cast<std::uint32_t>(positions.size() / 3);
  for (const double value : {x, y, z}) positions.push_back(static_cast<float>(value));
  return index;
}

void BuiltInMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

BuiltInMesh cube() {
  BuiltInMesh mesh{"cube", {}, {}};
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    mesh.add_vertex(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& side : kSides) {
    mesh.add_triangle(side[0], side[1], side[2]);
    mesh.add_triangle(side[0], side[2], side[3]);
  }
  return mesh;
}

BuiltInMesh prism(std::uint32_t sides, std::uint32_t layers, double radius, double height) {
  BuiltInMesh mesh{fmt::format("prism, {} sides, {} layers", sides, layers), {}, {}};
  for (std::uint32_t ring = 0; ring <= layers; ++ring)
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / sides;
      mesh.add_vertex(radius * std::cos(angle), height * ring / layers, radius * std::sin(angle));
    }
  const std::uint32_t bottom = mesh.add_vertex(0, 0, 0);
  const std::uint32_t top = mesh.add_vertex(0, height, 0);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t next = (side + 1) % sides;
    for (std::uint32_t ring = 0; ring < layers; ++ring) {
      const std::uint32_t low = ring * sides, high = low + sides;
      mesh.add_triangle(low + side, high + side, low + next);
      mesh.add_triangle(low + next, high + side, high + next);
    }
    mesh.add_triangle(bottom, side, next);
    mesh.add_triangle(top, layers * sides + next, layers * sides + side);
  }
  return mesh;
}

BuiltInMesh geosphere(std::uint32_t levels) {
  BuiltInMesh mesh{"geosphere", {}, {}};
  const double golden = std::numbers::phi;
  const auto add_on_sphere = [&](double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    return mesh.add_vertex(x / length, y / length, z / length);
  };
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden}) {
      add_on_sphere(a, b, 0);
      add_on_sphere(0, a, b);
      add_on_sphere(b, 0, a);
    }
  // Vertices: 0 (-,-,0) 1 (0,-,-) 2 (-,0,-) 3 (-,+,0) 4 (0,-,+) 5 (+,0,-) 6 (+,-,0) 7 (0,+,-) 8 (-,0,+) 9
  // (+,+,0) 10 (0,+,+) 11 (+,0,+).
  mesh.indices = {3, 8, 10, 3, 10, 9, 3,  9,  7, 3, 7, 2,  3, 2, 8, 9, 10, 11, 10, 8,
                  4, 8, 2,  0, 2,  7, 1,  7,  9, 5, 6, 11, 4, 6, 4, 0, 6,  0,  1,  6,
                  1, 5, 6,  5, 11, 4, 11, 10, 0, 4, 8, 1,  0, 2, 5, 1, 7,  11, 5,  9};
  for (std::uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) {
        const auto sum = [&](std::size_t axis) {
          return static_cast<double>(mesh.positions[3 * a + axis]) +
                 static_cast<double>(mesh.positions[3 * b + axis]);
        };
        entry->second = add_on_sphere(sum(0), sum(1), sum(2));
      }
      return entry->second;
    };
    const auto coarse = std::exchange(mesh.indices, {});
    for (std::size_t i = 0; i < coarse.size(); i += 3) {
      const std::uint32_t a = coarse[i], b = coarse[i + 1], c = coarse[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      mesh.add_triangle(a, ab, ca);
      mesh.add_triangle(b, bc, ab);
      mesh.add_triangle(c, ca, bc);
      mesh.add_triangle(ab, bc, ca);
    }
  }
  return mesh;
}

BuiltInMesh split_tetrahedron(std::uint32_t levels) {
  BuiltInMesh mesh{fmt::format("tetrahedron, side split {}x", levels), {}, {}};
  for (const auto& [x, y, z] :
       {std::array{0.0, 0.0, 0.0}, {27.0, 0.0, 0.0}, {0.0, 27.0, 0.0}, {0.0, 0.0, 27.0}})
    mesh.add_vertex(x, y, z);
  for (const auto& [a, b] : {std::array<std::uint32_t, 2>{0, 1}, {1, 2}, {2, 0}}) mesh.add_triangle(a, b, 3);
  std::vector<std::array<std::uint32_t, 3>> base = {{1, 0, 2}};
  for (std::uint32_t level = 0; level < levels; ++level) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const std::array<std::uint32_t, 3>& face : base) {
      const auto mean = [&](std::size_t axis) {
        double sum = 0;
        for (const std::uint32_t corner : face) sum += static_cast<double>(mesh.positions[3 * corner + axis]);
        return sum / 3;
      };
      const auto [a, b, c] = face;
      const std::uint32_t centre = mesh.add_vertex(mean(0), mean(1), 0);  // exactly in the plane of the base
      finer.insert(finer.end(), {{a, b, centre}, {b, c, centre}, {c, a, centre}});
    }
    base = std::move(finer);
  }
  for (const auto& [a, b, c] : base) mesh.add_triangle(a, b, c);
  return mesh;
}

BuiltInMesh flat_grid(std::uint32_t cells) {
  BuiltInMesh mesh{fmt::format("flat grid {}x{}", cells, cells), {}, {}};
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x) mesh.add_vertex(x, y, 0);
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t corner = y * (cells + 1) + x, above = corner + cells + 1;
      mesh.add_triangle(corner, corner + 1, above + 1);
      mesh.add_triangle(corner, above + 1, above);
    }
  return mesh;
}

BuiltInMesh square_tube(std::uint32_t split_rims) {
  BuiltInMesh mesh{fmt::format("square tube, {} split rims", split_rims), {}, {}};
  const double half = 2.5 * std::numbers::sqrt2;  // the rim's edges are 5 sqrt 2 long
  const double split = half - 2;  // edges are split 2 beside their middle: areas (half -+ 2) * 10 / 2
  static constexpr std::array<std::array<double, 2>, 4> kCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const double y : {0.0, 10.0})
    for (const auto& [x, z] : kCorners) mesh.add_vertex(x * half, y, z * half);
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::uint32_t next = (side + 1) % 4;
    const auto on_edge = [&](double from_here, double y) {
      const double t = from_here / (2 * half);
      const auto& a = kCorners[side];
      const auto& b = kCorners[next];
      return mesh.add_vertex((a[0] + t * (b[0] - a[0])) * half, y, (a[1] + t * (b[1] - a[1])) * half);
    };
    const std::uint32_t low = side, low_next = next, high = 4 + side, high_next = 4 + next;
    if (split_rims == 0) {
      mesh.add_triangle(low, high, low_next);
      mesh.add_triangle(low_next, high, high_next);
      continue;
    }
    const std::uint32_t bottom = on_edge(split, 0);
    mesh.add_triangle(low, high, bottom);
    mesh.add_triangle(bottom, high_next, low_next);
    if (split_rims == 1) {
      mesh.add_triangle(bottom, high, high_next);
      continue;
    }
    const std::uint32_t top = on_edge(2 * half - split, 10);
    mesh.add_triangle(bottom, high, top);
    mesh.add_triangle(bottom, top, high_next);
  }
  return mesh;
}

}  // namespace scene_analyzer::cli
