// Defects on the device against the plain twin, and meshes whose defects are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "defects/defect_finder.h"
#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/scenes.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::defects {
namespace {

using analysis::Defect;
using analysis::Defects;
using test_meshes::TestMesh;
using testing::ElementsAre;

using Counts = std::map<Defect, std::uint64_t>;
using Places = std::vector<std::uint32_t>;

std::string text_of(const Defects& defects) {
  std::string text;
  for (const analysis::FoundDefect& one : defects.found) {
    text +=
        std::string(analysis::kDefectKeys[index_of(one.defect)]) + ' ' + std::to_string(one.count) + " at";
    for (const std::uint32_t place : one.places) text += ' ' + std::to_string(place);
    text += '\n';
  }
  return text;
}

Counts counts_of(const Defects& defects) {
  Counts counts;
  for (const analysis::FoundDefect& one : defects.found) counts[one.defect] = one.count;
  return counts;
}

Places places_of(const Defects& defects, Defect defect) {
  const analysis::FoundDefect* found = defects.find(defect);
  return found == nullptr ? Places() : found->places;
}

class DefectsTest : public test::GpuTest {
 protected:
  std::vector<Defects> find(const std::vector<TestMesh>& meshes, double weld_tolerance = 0) {
    const mesh::Scene scene = test::scene_of(meshes);
    geometry::Batch batch;
    for (const mesh::TriangleMesh& mesh : scene.meshes) batch.meshes.push_back({.mesh = &mesh});
    static const DefectFinder& finder = *new DefectFinder(device());  // as long as the shared device
    test::Kernels& kernels = test::kernels(device());
    gpu::Recorder recorder(device());
    const geometry::Geometry geometry = kernels.geometry.record(recorder, batch, weld_tolerance);
    auto matching = kernels.adjacency.record_matching(recorder, geometry);
    recorder.submit_and_wait();
    const auto adjacency = kernels.adjacency.complete(device(), geometry, std::move(matching));
    const ChunkDefects chunks = finder.record(recorder, geometry, adjacency);
    recorder.submit_and_wait();
    return read_defects(device(), geometry, chunks);
  }

  Defects find(const TestMesh& mesh, double weld_tolerance = 0) {
    return find(std::vector{mesh}, weld_tolerance).front();
  }

  void compare(const TestMesh& mesh) {
    SCOPED_TRACE(mesh.name);
    const Defects found = find(mesh);
    EXPECT_EQ(text_of(found), text_of(reference::evaluate_stages(mesh).defects));
    EXPECT_EQ(text_of(found), text_of(find(mesh))) << "a second run";
  }
};

TEST_F(DefectsTest, AgreeWithTheTwinOnTheCatalogue) {
  for (const TestMesh& mesh : test::measurable_meshes()) compare(mesh);
}

TEST_F(DefectsTest, AgreeWithTheTwinOnNastySizes) {
  for (const std::uint32_t size : test_meshes::nasty_sizes()) {
    compare(test_meshes::grid(size, 1));
    compare(test_meshes::unwelded(test_meshes::grid(size, 1)));
    compare(test_meshes::book(size, size));
    compare(test_meshes::indexed_soup(8, size, size));
    compare(test_meshes::lattice_soup(2, size, size));
  }
}

// Most of these have every kind of defect of triangles and vertices.
TEST_F(DefectsTest, AgreeWithTheTwinOnSeededRandomMeshes) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test_meshes::Random random(seed);
    const auto vertices = static_cast<std::uint32_t>(5 + random.below(40));
    const auto triangles = static_cast<std::uint32_t>(1 + random.below(1500));
    TestMesh mesh = test_meshes::spread(
        "random " + std::to_string(seed),
        {test_meshes::indexed_soup(vertices, triangles, seed), test_meshes::lattice_soup(3, triangles, seed),
         test_meshes::flipped(test_meshes::grid(5, 5), seed)},
        3);
    for (std::uint32_t extra = 0; extra < random.below(200); ++extra) mesh.vertex(random.unit(), 0, 0);
    for (std::uint64_t n = random.below(5); n > 0; --n)
      mesh.positions[random.below(mesh.positions.size())] = std::numeric_limits<float>::infinity();
    compare(mesh);
  }
}

TEST_F(DefectsTest, MeshesOfOneBatchHaveTheirOwn) {
  const std::vector<TestMesh> meshes = test::measurable_meshes();
  const std::vector<Defects> together = find(meshes);
  ASSERT_EQ(together.size(), meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
    EXPECT_EQ(text_of(together[i]), text_of(find(meshes[i]))) << meshes[i].name;
}

TEST_F(DefectsTest, ShufflingKeepsTheCounts) {
  for (const TestMesh& mesh : test::measurable_meshes())
    EXPECT_EQ(counts_of(find(test_meshes::shuffled(mesh, 5))), counts_of(find(mesh))) << mesh.name;
}

TEST_F(DefectsTest, ACubeHasNone) {
  EXPECT_EQ(text_of(find(test_meshes::cube())), "");
}

// Each triangle's three edges, of which the two halves of a face share one.
TEST_F(DefectsTest, OneFlippedFaceOfACube) {
  TestMesh mesh = test_meshes::cube();
  std::swap(mesh.indices[3 * 7 + 1], mesh.indices[3 * 7 + 2]);
  const Defects one = find(mesh);
  EXPECT_EQ(counts_of(one), (Counts{{Defect::kInconsistentWinding, 3}}));
  EXPECT_EQ(places_of(one, Defect::kInconsistentWinding).size(), 3U);
  std::swap(mesh.indices[3 * 6 + 1], mesh.indices[3 * 6 + 2]);
  EXPECT_EQ(find(mesh).count(Defect::kInconsistentWinding), 4U) << "both halves: the square's four sides";
}

TEST_F(DefectsTest, DuplicatesAreFoundInAnyOrderOfCorners) {
  const TestMesh cube = test_meshes::cube();
  const std::array<std::array<std::uint32_t, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& order : orders) {
    TestMesh mesh = cube;
    const std::uint32_t* corner = &cube.indices[3 * 4];
    mesh.triangle(corner[order[0]], corner[order[1]], corner[order[2]]);
    const Defects found = find(mesh);
    EXPECT_EQ(counts_of(found), (Counts{{Defect::kDuplicateTriangles, 1}, {Defect::kNonManifoldEdges, 3}}));
    EXPECT_THAT(places_of(found, Defect::kDuplicateTriangles), ElementsAre(12));
  }
}

// Without any other triangle on their edges, with one on some edges, and far more than two of them.
TEST_F(DefectsTest, DuplicatesAreFoundWhateverIsOnTheirEdges) {
  TestMesh pair = test_meshes::single_triangle();
  pair.triangle(2, 1, 0);
  EXPECT_EQ(counts_of(find(pair)), (Counts{{Defect::kDuplicateTriangles, 1}}));
  pair.triangle(0, 1, pair.vertex(0, 0, 1));
  EXPECT_EQ(counts_of(find(pair)), (Counts{{Defect::kDuplicateTriangles, 1},
                                           {Defect::kNonManifoldEdges, 1},
                                           {Defect::kBoundaryEdges, 2}}));
  TestMesh pile = test_meshes::single_triangle();
  for (int copy = 1; copy < 1000; ++copy) pile.triangle(0, 1, 2);
  const Defects found = find(pile);
  EXPECT_EQ(counts_of(found), (Counts{{Defect::kDuplicateTriangles, 999}, {Defect::kNonManifoldEdges, 3}}));
  EXPECT_THAT(places_of(found, Defect::kDuplicateTriangles), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(places_of(found, Defect::kNonManifoldEdges), ElementsAre(0));
}

TEST_F(DefectsTest, DuplicatesAreFoundThroughSeparateVertices) {
  EXPECT_EQ(find(test_meshes::unwelded(test_meshes::doubled_faces(test_meshes::cube())))
                .count(Defect::kDuplicateTriangles),
            12U);
}

TEST_F(DefectsTest, VerticesThatAWeldWouldMerge) {
  TestMesh cube{"four vertices per side", {}, {}};
  const TestMesh shared = test_meshes::cube();
  for (std::size_t side = 0; side < 6; ++side) {
    std::map<std::uint32_t, std::uint32_t> copies;
    for (std::size_t i = 6 * side; i < 6 * side + 6; ++i) {
      const std::uint32_t v = shared.indices[i];
      if (!copies.contains(v))
        copies[v] =
            cube.vertex(shared.positions[3 * v], shared.positions[3 * v + 1], shared.positions[3 * v + 2]);
      cube.indices.push_back(copies[v]);
    }
  }
  ASSERT_EQ(cube.vertex_count(), 24U);
  const Defects found = find(cube);
  EXPECT_EQ(counts_of(found), (Counts{{Defect::kMergeableVertices, 16}}));
  EXPECT_EQ(places_of(found, Defect::kMergeableVertices).size(), analysis::kMostDefectPlaces);
  for (float& x : cube.positions) x *= 1 + std::numeric_limits<float>::epsilon();
  cube.positions[0] += 1e-4F;
  EXPECT_EQ(find(cube).count(Defect::kMergeableVertices), 15U);
  EXPECT_EQ(find(cube, 1e-3).count(Defect::kMergeableVertices), 16U);
}

TEST_F(DefectsTest, VerticesThatAreNotFiniteOrNotUsed) {
  TestMesh mesh = test_meshes::cube();
  const std::uint32_t unused = mesh.vertex(0.5, 0.5, 0.5);
  const std::uint32_t lost = mesh.vertex(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  const std::uint32_t endless = mesh.vertex(0, -std::numeric_limits<double>::infinity(), 0);
  mesh.triangle(0, 1, lost);
  mesh.triangle(0, lost, 0);
  const Defects found = find(mesh);
  EXPECT_EQ(counts_of(found), (Counts{{Defect::kDegenerateByIndex, 1},
                                      {Defect::kDegenerateByShape, 1},
                                      {Defect::kUnreferencedVertices, 2},
                                      {Defect::kNonFiniteVertices, 2}}));
  EXPECT_THAT(places_of(found, Defect::kDegenerateByIndex), ElementsAre(13));
  EXPECT_THAT(places_of(found, Defect::kDegenerateByShape), ElementsAre(12));
  EXPECT_THAT(places_of(found, Defect::kUnreferencedVertices), ElementsAre(unused, endless));
  EXPECT_THAT(places_of(found, Defect::kNonFiniteVertices), ElementsAre(lost, endless));
}

TEST_F(DefectsTest, PlacesAreThoseOfTheMeshAndTheLowest) {
  TestMesh mesh = test_meshes::geosphere(30);
  const auto triangles = static_cast<std::uint32_t>(mesh.triangle_count());
  const auto last = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::uint32_t i = 0; i < 20; ++i) mesh.triangle(i, i, i + 1);
  for (std::uint32_t i = 0; i < 3; ++i) mesh.vertex(0, 0, 0.1 * i);
  const std::vector<Defects> found = find({test_meshes::grid(30, 30), mesh});
  EXPECT_EQ(counts_of(found[1]),
            (Counts{{Defect::kDegenerateByIndex, 20}, {Defect::kUnreferencedVertices, 3}}));
  Places first(8);
  for (std::uint32_t i = 0; i < 8; ++i) first[i] = triangles + i;
  EXPECT_EQ(places_of(found[1], Defect::kDegenerateByIndex), first);
  EXPECT_THAT(places_of(found[1], Defect::kUnreferencedVertices), ElementsAre(last, last + 1, last + 2));
}

TEST_F(DefectsTest, AMeshWithoutAreaSaysSo) {
  EXPECT_EQ(find(test_meshes::all_degenerate()).count(Defect::kZeroArea), 1U);
  EXPECT_EQ(find(test_meshes::single_triangle()).count(Defect::kZeroArea), 0U);
}

TEST_F(DefectsTest, ACubeFarAway) {
  const TestMesh cube = test_meshes::scaled(test_meshes::cube(), 100);
  EXPECT_EQ(find(test_meshes::moved(cube, 1e8, 0, 0)).count(Defect::kFarFromOrigin), 1U);
  EXPECT_EQ(find(test_meshes::moved(cube, 0, -1e5, 0)).count(Defect::kFarFromOrigin), 0U);
  EXPECT_EQ(find(test_meshes::moved(test_meshes::cube(), 0, 0, 1e8)).count(Defect::kFarFromOrigin), 1U)
      << "nothing is left of its third side";
}

TEST_F(DefectsTest, OnlyVerticesThatTrianglesUseSayHowFarAMeshIs) {
  TestMesh near = test_meshes::cube();
  near.vertex(1e8, 0, 0);
  EXPECT_EQ(counts_of(find(near)), (Counts{{Defect::kUnreferencedVertices, 1}}));
  TestMesh far = test_meshes::moved(test_meshes::scaled(test_meshes::cube(), 100), 1e8, 0, 0);
  far.vertex(0, 0, 0);
  far.triangle(0, 1, far.vertex(0, -std::numeric_limits<double>::infinity(), 0));
  const Defects found = find(far);
  EXPECT_EQ(found.count(Defect::kUnreferencedVertices), 1U);
  EXPECT_EQ(found.count(Defect::kFarFromOrigin), 1U);
}

// Masks are read back some hundred thousand triangles at a time.
TEST_F(DefectsTest, PlacesAtTheEndOfALargeMesh) {
  TestMesh mesh = test_meshes::torus(600, 300);
  const auto triangles = static_cast<std::uint32_t>(mesh.triangle_count());
  for (std::uint32_t i = 0; i < 3; ++i) mesh.triangle(i, i, i);
  const std::vector<Defects> found = find({test_meshes::cube(), mesh, test_meshes::geosphere(4), mesh});
  for (const std::size_t i : {1U, 3U}) {
    EXPECT_EQ(counts_of(found[i]), (Counts{{Defect::kDegenerateByIndex, 3}}));
    EXPECT_THAT(places_of(found[i], Defect::kDegenerateByIndex),
                ElementsAre(triangles, triangles + 1, triangles + 2));
  }
}

// Software devices end a thread's loops after 65535 steps, and nothing may take k^2.
TEST_F(DefectsTest, EdgesWithVeryManyTrianglesAreLinear) {
  TestMesh pile = test_meshes::book(50'000, 3);
  const std::size_t pages = pile.triangle_count();
  for (std::size_t i = 0; i < 3 * pages; ++i) pile.indices.push_back(pile.indices[i]);
  const Defects found = find(pile);
  EXPECT_EQ(found.count(Defect::kDuplicateTriangles), pages);
  EXPECT_EQ(found.count(Defect::kNonManifoldEdges), 1U);
}

TEST_F(DefectsTest, ManyTrianglesWhoseEdgesAreAllShared) {
  compare(test_meshes::indexed_soup(60, 120'000, 9));
}

}  // namespace
}  // namespace scene_analyzer::defects
