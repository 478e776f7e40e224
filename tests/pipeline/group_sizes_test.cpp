// The planar group sizes that pictures show, triangle by triangle, against the plain twin.
#include <gtest/gtest.h>

#include <map>

#include "pipeline/measure.h"
#include "reference/evaluate.h"
#include "support/gpu_test.h"
#include "support/scenes.h"

namespace scene_analyzer::pipeline {
namespace {

class GroupSizesTest : public test::GpuTest {};

TEST_F(GroupSizesTest, AreThoseOfTheTwinForTheWholeCatalogue) {
  const mesh::Scene scene = test::scene_of(test_meshes::small_catalogue());
  analysis::AssetAnalysis analysis;
  std::map<std::uint32_t, std::vector<std::uint32_t>> found;
  Measurer(device()).measure(
      {.scene = scene,
       .analysis = analysis,
       .metrics = analysis::MetricSet().set(index_of(analysis::Metric::kPlanarGroupVariation)),
       .group_sizes = [&](std::uint32_t geometry, std::vector<std::uint32_t> sizes) {
         found[geometry] = std::move(sizes);
       }});
  for (std::uint32_t g = 0; g < analysis.geometries.size(); ++g) {
    const mesh::TriangleMesh& mesh = scene.meshes[analysis.geometries[g].mesh];
    if (analysis.geometries[g].triangles == 0) {
      EXPECT_EQ(found.count(g), 0U) << mesh.name;
      continue;
    }
    const reference::Evaluation twin = reference::evaluate_stages(mesh.positions, mesh.indices);
    ASSERT_EQ(found[g].size(), mesh.triangle_count()) << mesh.name;
    for (std::size_t t = 0; t < found[g].size(); ++t)
      ASSERT_EQ(found[g][t], twin.triangles.kept[t] ? twin.groups.size[twin.groups.group[t]] : 0)
          << mesh.name << ", triangle " << t;
  }
}

}  // namespace
}  // namespace scene_analyzer::pipeline
