// selftest_meshes.h — Meshes whose results can be derived on paper, built in code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scene_analyzer::cli {

struct BuiltInMesh {
  std::string name;
  std::vector<float> positions;        // x, y, z per vertex
  std::vector<std::uint32_t> indices;  // three per triangle, consistently wound

  std::uint32_t add_vertex(double x, double y, double z);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

// Edge length 2; every side two triangles.
BuiltInMesh cube();
// Closed, `layers` rings of 2 x `sides` triangles, caps are fans about a centre vertex: 2 sides (layers + 1)
// triangles.
BuiltInMesh prism(std::uint32_t sides, std::uint32_t layers, double radius, double height);
// An icosahedron of radius 1, every triangle split into four `levels` times: 20 x 4^levels triangles.
BuiltInMesh geosphere(std::uint32_t levels);
// A tetrahedron whose base is split at its centre `levels` times: 3 + 3^levels triangles.
BuiltInMesh split_tetrahedron(std::uint32_t levels);
// Flat, open, cells x cells squares of two equal triangles.
BuiltInMesh flat_grid(std::uint32_t cells);
// A square tube of height 10 without caps: 8 triangles of area 35.3553. Each split rim edge (bottom, then
// top) turns four of them into triangles of areas 7.6778 and 27.6776; `split_rims` is 0, 1 or 2.
BuiltInMesh square_tube(std::uint32_t split_rims);

}  // namespace scene_analyzer::cli
