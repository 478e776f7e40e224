// Planar groups on the device against the plain twin, which decides angles by atan2.
#include "planar_groups/planar_groups.h"

#include <gtest/gtest.h>

#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::planar_groups {
namespace {

using test_meshes::TestMesh;

class PlanarGroupsTest : public test::GpuTest {
 protected:
  void compare(const TestMesh& mesh, double alpha) {
    SCOPED_TRACE(mesh.name + " at " + std::to_string(alpha) + " degrees");
    analysis::Parameters parameters;
    parameters.alpha_degrees = alpha;
    const auto twin = reference::evaluate_stages(mesh, parameters);
    const test::MeshOnDevice found = test::measure_up_to_adjacency(device(), mesh);
    gpu::Recorder recorder(device());
    const PlanarGroups groups = builder().record(recorder, found.geometry, found.adjacency, alpha);
    recorder.submit_and_wait();
    const auto totals = found.geometry.chunks.results(device(), groups.totals).front();
    EXPECT_EQ(totals.groups, twin.groups.count);
    EXPECT_EQ(totals.largest, twin.groups.largest);
    EXPECT_EQ(totals.squared_sizes, static_cast<double>(twin.groups.squared_sizes));
    const auto labels = groups.labels.download(device());
    for (std::size_t t = 0; t < labels.size(); ++t)
      if (twin.triangles.kept[t]) {
        ASSERT_EQ(labels[t], twin.groups.group[t]) << t;
      }
  }

  const PlanarGroupBuilder& builder() {
    static auto& kept =
        *new PlanarGroupBuilder(device(), test::kernels(device()).scan, test::kernels(device()).sort);
    return kept;
  }
};

TEST_F(PlanarGroupsTest, AgreesWithTheTwinOnTheCatalogue) {
  for (const TestMesh& mesh : test::measurable_meshes())
    for (const double alpha : {0.0, 5.0, 60.0}) compare(mesh, alpha);
}

TEST_F(PlanarGroupsTest, AnglesUpToAHalfTurn) {
  for (const double alpha : {89.5, 90.0, 120.0, 178.5, 179.5, 180.0}) {
    compare(test_meshes::cube(), alpha);
    compare(test_meshes::indexed_soup(12, 300, 1), alpha);
    compare(test_meshes::book(200, 2), alpha);
    compare(test_meshes::flipped(test_meshes::torus(16, 8), 3), alpha);
  }
}

TEST_F(PlanarGroupsTest, ManyTrianglesOnOneEdge) {
  for (const std::uint32_t pages : {3U, 4U, 64U, 65U, 1000U})
    for (const std::uint32_t planes : {0U, 2U, 7U})
      for (const double alpha : {0.0, 0.5, 20.0}) compare(test_meshes::book(pages, pages, planes), alpha);
}

TEST_F(PlanarGroupsTest, WindingDoesNotMatter) {
  compare(test_meshes::flipped(test_meshes::grid(20, 20), 4), 0);
  compare(test_meshes::mobius_strip(64), 10);
  compare(test_meshes::klein_bottle(24, 12), 15);
}

}  // namespace
}  // namespace scene_analyzer::planar_groups
