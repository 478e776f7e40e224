// Twins, components and edge counts on the device against the plain twin.
#include "adjacency/adjacency.h"

#include <gtest/gtest.h>

#include <set>

#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::adjacency {
namespace {

using interface::adjacency::kShared;
using interface::mesh::kNone;
using test_meshes::TestMesh;

class AdjacencyTest : public test::GpuTest {
 protected:
  void compare(const TestMesh& mesh) {
    SCOPED_TRACE(mesh.name);
    const auto twin = reference::evaluate_stages(mesh);
    const test::MeshOnDevice found = test::measure_up_to_adjacency(device(), mesh);
    const auto totals = found.geometry.chunks.results(device(), found.adjacency.totals).front();
    EXPECT_EQ(totals.components, twin.adjacency.components);
    EXPECT_EQ(totals.isolated, twin.adjacency.isolated_triangles);
    EXPECT_EQ(totals.boundary_edges, twin.adjacency.boundary_edges);
    EXPECT_EQ(totals.non_manifold_edges, twin.adjacency.non_manifold_edges);
    const auto labels = found.adjacency.labels.download(device());
    for (std::size_t t = 0; t < labels.size(); ++t)
      if (twin.triangles.kept[t]) {
        ASSERT_EQ(labels[t], twin.adjacency.component[t]) << t;
      }
    compare_twins(twin.adjacency, found.adjacency);
  }

  void compare_twins(const reference::Adjacency& expected, const Adjacency& found) {
    const auto twin = found.twin.download(device());
    const auto members =
        found.shared.count > 0 ? found.shared.half_edges.download(device()) : std::vector<std::uint32_t>();
    const auto ends = found.shared.ends.download(device());
    std::size_t shared = 0;
    for (std::size_t e = 0; e < expected.edge_count(); ++e) {
      const auto edge = expected.edge(e);
      if (edge.size() == 1) {
        ASSERT_EQ(twin[edge[0]], kNone);
      }
      if (edge.size() == 2) {
        ASSERT_EQ(twin[edge[0]], edge[1]);
        ASSERT_EQ(twin[edge[1]], edge[0]);
      }
      if (edge.size() <= 2) continue;
      shared += edge.size();
      const std::uint32_t begin = twin[edge[0]] & ~kShared;
      for (std::size_t i = 0; i < edge.size(); ++i) {
        ASSERT_EQ(twin[edge[i]], kShared | begin);
        ASSERT_EQ(members[begin + i], edge[i]);
      }
      ASSERT_EQ(ends[begin], begin + edge.size());
    }
    EXPECT_EQ(found.shared.count, shared);
  }
};

TEST_F(AdjacencyTest, AgreesWithTheTwinOnTheCatalogue) {
  for (const TestMesh& mesh : test::measurable_meshes()) compare(mesh);
}

TEST_F(AdjacencyTest, AgreesWithTheTwinOnNastySizes) {
  for (const std::uint32_t size : test_meshes::nasty_sizes()) {
    compare(test_meshes::grid(size, 1));
    compare(test_meshes::book(size, size));
    compare(test_meshes::cone_fan(size + 2));
    compare(test_meshes::indexed_soup(20, size, size));
  }
}

TEST_F(AdjacencyTest, AHubVertexOfHighValence) {
  compare(test_meshes::cone_fan(50'000));
}

// Software devices end a thread's loops after 65535 steps: no thread may walk an edge.
TEST_F(AdjacencyTest, AnEdgeWithVeryManyTriangles) {
  compare(test_meshes::book(100'000, 3));
}

TEST_F(AdjacencyTest, ShuffledTrianglesHaveTheSameCounts) {
  for (const TestMesh& mesh : test::measurable_meshes()) compare(test_meshes::shuffled(mesh, 5));
}

}  // namespace
}  // namespace scene_analyzer::adjacency
