// Scenes on the device: memory, pages, failures.
#include "scene_render/scene_model_builder.h"

#include <algorithm>
#include <iterator>

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

// The first allocation that fails is that of the textures, the page of meshes, or the page of groups.
TEST_F(SceneModelTest, WhatDoesNotFitIsLeftOutAndSaid) {
  mesh::Scene scene = scene_of({test_meshes::geosphere(20), test_meshes::cube()});
  const std::vector<std::uint8_t> pixels(4 * 4 * 4, 200);
  const std::vector<float> coordinates(2 * scene.meshes[1].vertex_count(), 0.5F);
  scene.textures.push_back({.path = "wood.png", .encoded = {}, .width = 4, .height = 4, .pixels = pixels});
  scene.materials.push_back({.name = "wood", .base_color = {}, .texture = 0});
  scene.meshes[1].material = 1;
  scene.meshes[1].texture_coordinates = coordinates;
  const GroupShades ball(8000, 3), cube(12, 3);

  std::vector<std::string> seen;
  for (std::uint32_t allocation = 0;; ++allocation) {
    SCOPED_TRACE(allocation);
    gpu::faults(device()).allocations_until_failure = allocation;
    SceneModelBuilder builder(device());
    builder.add(scene, std::vector<const GroupShades*>{&ball, &cube});
    const SceneModel model = builder.finish();
    const bool failed = !gpu::faults(device()).allocations_until_failure;
    gpu::faults(device()) = {};
    const std::vector<std::string> warnings = builder.take_warnings();
    EXPECT_EQ(model.size(), 2U) << "rows stay";
    std::ranges::copy(warnings, std::back_inserter(seen));
    EXPECT_EQ(warnings.empty(), !failed);
    EXPECT_EQ(model.box(0).has_value(), model.triangles() != 0);
    // What is left can be drawn.
    const std::vector<Look> looks(2, {.fill = Look::Fill::kGroups});
    const Picture picture =
        SceneRenderer(device(), 1).draw(model, {.eye = {0, 0, 9}, .target = {}}, looks, 16, 16);
    EXPECT_EQ(picture.rgba[4 * (8 * 16 + 8)] == 255, model.triangles() == 0);
    if (!failed) break;
  }
  EXPECT_THAT(seen, testing::Contains(testing::HasSubstr("texture wood.png is not shown: ")));
  EXPECT_THAT(seen, testing::Contains(testing::HasSubstr("mesh \"cube\" is not drawn: ")));
  EXPECT_THAT(seen, testing::Contains(testing::HasSubstr("planar groups of some meshes are not shown: ")));
}

TEST_F(SceneModelTest, ModelsAppendedDrawWhatOneWouldDraw) {
  const mesh::Scene first = scene_of({test_meshes::moved(test_meshes::cube(), -3, 0, 0)}),
                    second = scene_of({test_meshes::geosphere(5), test_meshes::single_triangle()});
  const GroupShades cube(12, 200), ball(second.meshes[0].triangle_count(), 30), triangle(1, 100);
  const std::vector<const GroupShades*> of_first{&cube}, of_second{&ball, &triangle};
  SceneModelBuilder builder(device());
  builder.add(first, of_first);
  SceneModel parts = builder.finish();
  builder.add(second, of_second);
  parts.append(builder.finish());
  parts.append({});
  builder.add(first, of_first);
  builder.add(second, of_second);
  const SceneModel whole = builder.finish();

  ASSERT_EQ(parts.size(), whole.size());
  EXPECT_EQ(parts.triangles(), whole.triangles());
  const std::vector<Look> looks(3, {.fill = Look::Fill::kGroups});
  const Camera camera{.eye = {0, 0, 12}, .target = {}};
  SceneRenderer renderer(device(), 1);
  EXPECT_EQ(renderer.draw(parts, camera, looks, 64, 64).rgba,
            renderer.draw(whole, camera, looks, 64, 64).rgba);
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
