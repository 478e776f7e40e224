// Scenes on the device: memory, pages, failures.
#include "scene_render/scene_model.h"

#include "gpu/error.h"
#include "gpu/faults.h"
#include "scene_render/scene_renderer.h"
#include "support/gpu_test.h"
#include "support/scenes.h"

namespace scene_analyzer::scene_render {
namespace {

using testing::ElementsAre;

class SceneModelTest : public test::GpuTest {
 protected:
  static mesh::Scene scene_of(std::vector<test_meshes::TestMesh> meshes) {
    mesh::Scene scene = test::scene_of(std::move(meshes));
    scene.materials.emplace_back();
    return scene;
  }
  SceneModel model_of(const mesh::Scene& scene, const std::vector<const GroupShades*>& groups = {}) {
    SceneModelBuilder builder(device());
    builder.add(scene, groups);
    return builder.finish();
  }
};

TEST_F(SceneModelTest, ATriangleTakesLessThan60Bytes) {
  for (test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const std::string name = mesh.name;
    const mesh::Scene scene = scene_of({std::move(mesh)});
    const GroupShades groups(scene.meshes[0].triangle_count(), 3);
    const SceneModel model = model_of(scene, {&groups});
    if (model.triangles() < 8) continue;  // a page of groups ends with a whole word
    EXPECT_LT(model.bytes(), 60 * model.triangles()) << name;
  }
}

TEST_F(SceneModelTest, LargeScenesTakeSeveralPagesAndStayWhole) {
  // Three meshes of 40 MB each do not fit a page of 64 MiB together.
  const test_meshes::TestMesh sphere = test_meshes::geosphere(260);
  const mesh::Scene scene = scene_of({test_meshes::moved(sphere, -3, 0, 0), test_meshes::cube(), sphere,
                                      test_meshes::moved(sphere, 3, 0, 0)});
  const SceneModel model = model_of(scene);
  EXPECT_GT(model.bytes(), std::uint64_t{64} << 20);
  EXPECT_LT(model.bytes(), 60 * model.triangles());
  const Camera camera{.eye = {0, 0, 20}, .target = {0, 0, 0}, .tangent = 0.25};
  const Look green{.fill = Look::Fill::kColor, .color = {0, 1, 0}},
      red{.fill = Look::Fill::kColor, .color = {1, 0, 0}};
  const Picture picture =
      SceneRenderer(device(), 1).draw(model, camera, std::vector{red, green, green, red}, 100, 100);
  const auto color_at = [&](std::size_t x) {
    return std::vector(&picture.rgba[4 * (50 * 100 + x)], &picture.rgba[4 * (50 * 100 + x) + 2]);
  };
  EXPECT_THAT(color_at(20), ElementsAre(testing::Gt(100), 0));
  EXPECT_THAT(color_at(50), ElementsAre(0, testing::Gt(100)));
  EXPECT_THAT(color_at(80), ElementsAre(testing::Gt(100), 0));
}

TEST_F(SceneModelTest, RunningOutOfMemoryIsSaid) {
  const mesh::Scene scene = scene_of({test_meshes::geosphere(20)});
  gpu::faults(device()).allocations_until_failure = 0;
  EXPECT_THROW(model_of(scene), gpu::OutOfMemory);
  gpu::faults(device()) = {};
  EXPECT_EQ(model_of(scene).triangles(), 8000U);
}

TEST_F(SceneModelTest, ScenesOfSeveralAssetsFollowEachOther) {
  SceneModelBuilder builder(device());
  builder.add(scene_of({test_meshes::cube(), test_meshes::geosphere(2)}));
  builder.add(scene_of({test_meshes::single_triangle()}));
  const SceneModel model = builder.finish();
  ASSERT_EQ(model.size(), 3U);
  EXPECT_EQ(model.triangles(), 12U + 80U + 1U);
  EXPECT_EQ(model.instance(2).mesh, 2U);
  EXPECT_FALSE(model.has_own_color(2));
}

TEST(ShadeGroups, GoFromATriangleAloneToTheLargestGroup) {
  EXPECT_THAT(shade_groups(std::array{1U, 2U, 4U, 11U, 0U}), ElementsAre(0, 26, 77, 255, 0));
  EXPECT_THAT(shade_groups(std::array{1U, 1U}), ElementsAre(0, 0)) << "all alone: green";
  EXPECT_THAT(shade_groups({}), ElementsAre());
}

}  // namespace
}  // namespace scene_analyzer::scene_render
