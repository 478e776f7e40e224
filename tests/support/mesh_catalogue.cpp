#include "support/meshes.h"

namespace scene_analyzer::test_meshes {
namespace {

void append(std::vector<TestMesh>& to, std::vector<TestMesh> meshes) {
  for (TestMesh& mesh : meshes) to.push_back(std::move(mesh));
}

std::vector<TestMesh> regular() {
  return {single_triangle(),
          two_triangles(0),
          two_triangles(0.5),
          two_triangles(30),
          two_triangles(180 - 0.005),
          cube(),
          split_tetrahedron(0),
          split_tetrahedron(1),
          split_tetrahedron(3),
          geosphere(1),
          geosphere(4),
          geosphere(12),
          prism(6, 5, 1, 3),
          prism(10, 1, 0.03, 0.12),
          prism(10, 1, 0.03, 0.4),
          prism(32, 8, 2, 5, false),
          four_sided_tube(0),
          four_sided_tube(1),
          four_sided_tube(2),
          grid(4, 4),
          grid(40, 30, 0.1),
          torus(48, 24),
          mobius_strip(60),
          klein_bottle(40, 24),
          cone_fan(3),
          cone_fan(1000)};
}

std::vector<TestMesh> soups() {
  TestMesh nearly_flat = heightfield(30, 2e-4, 5);
  nearly_flat.name = "nearly flat grid";
  return {heightfield(32, 1, 1),
          heightfield(40, 0.02, 2),
          nearly_flat,
          book(3, 1),
          book(4, 2, 4),
          book(200, 3),
          book(1500, 4, 7),
          isolated_soup(500, 1),
          indexed_soup(12, 600, 1),
          indexed_soup(60, 3000, 2),
          indexed_soup(2000, 3000, 3),
          lattice_soup(3, 800, 1),
          lattice_soup(6, 2500, 2),
          non_finite(1),
          all_degenerate(),
          slivers(400, 1),
          signed_zeros(),
          nearly_equal_areas(3000, 1)};
}

std::vector<TestMesh> variants() {
  const TestMesh field = heightfield(20, 0.5, 9);
  TestMesh empty{"empty", {}, {}};
  TestMesh no_triangles{"vertices only", {0, 0, 0, 1, 1, 1}, {}};
  return {unwelded(field),
          unwelded(geosphere(8)),
          shuffled(unwelded(torus(20, 12)), 1),
          flipped(field, 1),
          flipped(prism(10, 3, 1, 2), 2),
          flipped(grid(20, 20), 3),
          moved(field, 1e6, -1e6, 1e6),
          moved(grid(20, 20, 0.25), 1e6, 0, 0),
          scaled(field, 1e-15),
          scaled(field, 1e15),
          scaled(prism(10, 2, 1, 2), 1e-20),
          scaled(cube(), 1e18),
          doubled_faces(cube()),
          doubled_faces(flipped(heightfield(12, 0.3, 4), 5)),
          spread("components", {cube(), geosphere(3), single_triangle(), torus(12, 8)}, 10),
          spread("mixed",
                 {book(60, 8, 5), all_degenerate(), grid(8, 8), slivers(50, 2), indexed_soup(20, 200, 6),
                  cone_fan(50)},
                 5),
          std::move(empty),
          std::move(no_triangles)};
}

}  // namespace

std::vector<TestMesh> small_catalogue() {
  std::vector<TestMesh> all = regular();
  append(all, soups());
  append(all, variants());
  for (const std::uint32_t size : nasty_sizes()) all.push_back(prism(size + 2, 1, 1, 1, false));
  for (const std::uint32_t size : nasty_sizes()) all.push_back(isolated_soup(size, size));
  return all;
}

std::vector<std::uint32_t> nasty_sizes() {
  return {1, 2, 63, 64, 65, 127, 128, 129, 255, 256, 257, 1023, 1024, 1025};
}

}  // namespace scene_analyzer::test_meshes
