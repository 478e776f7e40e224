// meshes.h — Catalogue of test meshes. Deterministic: the same numbers on every machine and standard library
// (but for the last bits of sine and cosine).
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace scene_analyzer::test_meshes {

struct TestMesh {
  std::string name;
  std::vector<float> positions;        // x, y, z per vertex
  std::vector<std::uint32_t> indices;  // three per triangle

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return indices.size() / 3; }
  std::uint32_t vertex(double x, double y, double z);  // appends, returns the index
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);  // (a, b, c) and (a, c, d)
};

// The standard's engine is the same everywhere, its distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }

 private:
  std::mt19937_64 engine_;
};

// --- Regular shapes (meshes.cpp) ---
TestMesh single_triangle();
TestMesh two_triangles(double fold_degrees);  // 0: one plane
TestMesh cube();                              // 12 triangles
TestMesh split_tetrahedron(int rounds);       // one face split into 3^rounds coplanar triangles
TestMesh geosphere(
    std::uint32_t frequency);  // 20 frequency^2 triangles on the unit sphere; frequency in [1, 4095]
// geosphere(20), 8000 triangles in 8000 groups, with triangles split: `flat` times into three of one plane
// (+2 triangles, +0 groups), `half` times at an edge so that one side stays in its plane (+2, +1), `raised`
// times into three of three planes (+2, +2). Together <= 40.
TestMesh split_geosphere(int flat, int half, int raised);
TestMesh geosphere_8006();  // 8002 planar groups
TestMesh geosphere_8010();  // 8005 planar groups
// Axis z, from 0 to height. Caps are fans about a centre: 2 sides (layers + caps) triangles.
TestMesh prism(std::uint32_t sides, std::uint32_t layers, double radius, double height, bool caps = true);
// Open, four sides, areas 35.3553: 8 triangles; with the lower or both triangles of each side split,
// areas 7.6778 and 27.6776: 12, 16.
TestMesh four_sided_tube(int split_per_side);
TestMesh grid(std::uint32_t columns, std::uint32_t rows,
              double cell = 1);  // flat, z = 0, 2 columns rows triangles
TestMesh heightfield(std::uint32_t side, double roughness,
                     std::uint64_t seed);                    // 2 side^2 triangles, unit cells
TestMesh torus(std::uint32_t around, std::uint32_t across);  // 2 around across triangles
TestMesh mobius_strip(std::uint32_t segments);               // 2 segments, cannot be wound consistently
TestMesh klein_bottle(std::uint32_t around, std::uint32_t across);  // closed, cannot be wound consistently
TestMesh cone_fan(std::uint32_t valence);                           // all triangles share a hub vertex

// --- Soups and broken meshes (mesh_soups.cpp) ---
// `pages` triangles on one edge. Random directions, or, with `planes` > 0, directions in that many
// half-planes.
TestMesh book(std::uint32_t pages, std::uint64_t seed, std::uint32_t planes = 0);
TestMesh isolated_soup(std::uint32_t triangles, std::uint64_t seed);
// Random vertex triples: repeated corners, duplicate faces, edges with many triangles.
TestMesh indexed_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint64_t seed);
// As above with vertices on a small integer lattice: coinciding vertices, collinear triples, coplanar faces.
TestMesh lattice_soup(std::uint32_t side, std::uint32_t triangles, std::uint64_t seed);
TestMesh non_finite(std::uint64_t seed);  // a heightfield, some coordinates NaN or infinite
TestMesh all_degenerate();
TestMesh slivers(
    std::uint32_t count,
    std::uint64_t seed);  // heights around 1e-6 of the longest edge, most of them kept or dropped by little
TestMesh signed_zeros();  // two triangles that meet where one writes -0
TestMesh nearly_equal_areas(std::uint32_t triangles, std::uint64_t seed);  // areas some 1e-7 apart

// --- The same mesh otherwise (mesh_variants.cpp) ---
TestMesh unwelded(const TestMesh& mesh);                      // three vertices per triangle, like STL
TestMesh shuffled(const TestMesh& mesh, std::uint64_t seed);  // order of triangles and of vertices
TestMesh flipped(const TestMesh& mesh, std::uint64_t seed);   // random triangles wound the other way
TestMesh moved(const TestMesh& mesh, double x, double y, double z);
TestMesh scaled(const TestMesh& mesh, double factor);
TestMesh doubled_faces(const TestMesh& mesh);  // every triangle twice
TestMesh joined(const std::string& name, const std::vector<TestMesh>& parts);
TestMesh spread(const std::string& name, const std::vector<TestMesh>& parts,
                double distance);  // joined, along x

// Each up to about 5000 triangles; every kind above and some mixed ones.
std::vector<TestMesh> small_catalogue();
// Counts around workgroup and block sizes.
std::vector<std::uint32_t> nasty_sizes();

}  // namespace scene_analyzer::test_meshes
