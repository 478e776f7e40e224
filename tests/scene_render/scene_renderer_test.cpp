// Colours of drawn meshes, in numbers.
#include "scene_render/scene_renderer.h"

#include "drawn_scene.h"
#include "scene_render/scene_model_builder.h"
#include "support/gpu_test.h"

namespace scene_analyzer::scene_render {
namespace {

using ratings::Rgb;
using test::Pixel;
using test::pixel;
using testing::Each;

constexpr std::uint32_t kSize = 100;  // pixels each way: ten per unit at z = 0
constexpr Rgb kRed = {1, 0, 0}, kYellow = {1, 1, 0};

MATCHER_P2(IsNear, expected, distance, "") {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(arg[i] - expected[i]) > distance) return false;
  return true;
}

class SceneRendererTest : public test::GpuTest {
 protected:
  SceneModel model(const GroupShades& groups = {}) {
    SceneModelBuilder builder(device());
    const std::vector<const GroupShades*> of_instance(rectangles_.scene().instances.size(), &groups);
    builder.add(rectangles_.scene(), of_instance);
    return builder.finish();
  }
  Picture draw(const std::vector<Look>& looks, std::uint32_t samples = 4) {
    return SceneRenderer(device(), samples).draw(model(), test::facing_camera(), looks, kSize, kSize);
  }

  test::RectangleScene rectangles_;
};

TEST_F(SceneRendererTest, MeshesHaveTheirColorWhereTheyAre) {
  rectangles_.add(-3, -2, 1, 4, 0);
  const Picture picture = draw({{.fill = Look::Fill::kColor, .color = kYellow}});
  const Pixel lit = test::shaded(kYellow, test::facing_shade());
  for (std::uint32_t y = 0; y < kSize; ++y)
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const bool inside = x >= 20 && x < 60 && y >= 10 && y < 70;
      ASSERT_THAT(pixel(picture, x, y), IsNear(inside ? lit : Pixel{255, 255, 255}, 1)) << x << ", " << y;
    }
}

TEST_F(SceneRendererTest, NearerMeshesHideFartherOnes) {
  rectangles_.add(-4, -4, 2, 4, 0);
  rectangles_.add(-1, -4, 4, 4, -1e-4);
  rectangles_.add(-1, -4, 4, 4, -1e4);
  const Look red{.fill = Look::Fill::kColor, .color = kRed},
      yellow{.fill = Look::Fill::kColor, .color = kYellow};
  const Picture picture = draw({red, yellow, red});
  EXPECT_EQ(pixel(picture, 60, 50), test::shaded(kRed, test::facing_shade()));
  EXPECT_EQ(pixel(picture, 80, 50), test::shaded(kYellow, test::facing_shade()));
}

TEST_F(SceneRendererTest, BothSidesAreLit) {
  rectangles_.add(-3, -3, 3, 3, 0);
  rectangles_.scene().instances[0].world = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  EXPECT_EQ(pixel(draw({{.fill = Look::Fill::kColor, .color = kRed}}), 50, 50),
            test::shaded(kRed, test::facing_shade()));
}

TEST_F(SceneRendererTest, OwnColorsLendTheirLuminance) {
  rectangles_.scene().materials.push_back(
      {.name = "blue", .base_color = std::array{0.2F, 0.4F, 0.8F, 1.0F}, .texture = {}});
  rectangles_.add(-4, -4, 0, 4, 0, 1);
  rectangles_.add(0, -4, 4, 4, 0, 0);
  const double luminance = 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.8;
  const Look red{.fill = Look::Fill::kColor, .color = kRed};
  Picture picture = draw({red, red});
  EXPECT_THAT(
      pixel(picture, 30, 50),
      IsNear(test::shaded({(1 + luminance) / 2, luminance / 2, luminance / 2}, test::facing_shade()), 1));
  EXPECT_THAT(pixel(picture, 70, 50), IsNear(test::shaded(kRed, test::facing_shade()), 1)) << "it has none";
  const Look own{.fill = Look::Fill::kOwnColor};
  picture = draw({own, own});
  EXPECT_THAT(pixel(picture, 30, 50), IsNear(test::shaded({0.2, 0.4, 0.8}, test::facing_shade()), 1));
  EXPECT_THAT(pixel(picture, 70, 50), IsNear(test::shaded({0.8, 0.8, 0.8}, test::facing_shade()), 1));
}

TEST_F(SceneRendererTest, TexturesStandUpright) {
  // Rows from the top: red, green; blue, white.
  const std::vector<std::uint8_t> pixels = {255, 0, 0,   255, 0,   255, 0,   255,
                                            0,   0, 255, 255, 255, 255, 255, 255};
  rectangles_.scene().textures.push_back(
      {.path = "four.png", .encoded = {}, .width = 2, .height = 2, .pixels = pixels});
  rectangles_.scene().materials.push_back(
      {.name = "four", .base_color = std::array{0.5F, 0.5F, 0.5F, 1.0F}, .texture = 0});
  rectangles_.add(-4, -4, 4, 4, 0, 1);
  Picture picture = draw({{.fill = Look::Fill::kOwnColor}});
  const double half = 0.5 * test::facing_shade();
  EXPECT_THAT(pixel(picture, 30, 30), IsNear(test::shaded({1, 0, 0}, half), 4)) << "upper left";
  EXPECT_THAT(pixel(picture, 69, 30), IsNear(test::shaded({0, 1, 0}, half), 4)) << "upper right";
  EXPECT_THAT(pixel(picture, 30, 69), IsNear(test::shaded({0, 0, 1}, half), 4)) << "lower left";
  EXPECT_THAT(pixel(picture, 69, 69), IsNear(test::shaded({1, 1, 1}, half), 4)) << "lower right";
  picture = draw({{.fill = Look::Fill::kColor, .color = kRed}});
  EXPECT_THAT(
      pixel(picture, 69, 30),
      IsNear(test::shaded({(1 + 0.587 * 0.5) / 2, 0.587 * 0.25, 0.587 * 0.25}, test::facing_shade()), 1));
}

TEST_F(SceneRendererTest, WithoutAValueMeshesAreGreyAndHatched) {
  rectangles_.add(-4, -4, 4, 4, 0);
  const Picture picture = draw({{.fill = Look::Fill::kNoValue}});
  int light = 0, dark = 0;
  for (std::uint32_t x = 20; x < 80; ++x) {
    const Pixel at = pixel(picture, x, 50);
    EXPECT_EQ(at[0], at[1]);
    EXPECT_EQ(at[1], at[2]);
    light += std::abs(at[0] - test::shaded(kNoValueGrey, test::facing_shade())[0]) <= 1 ? 1 : 0;
    dark += std::abs(at[0] - test::shaded(kNoValueGrey, kStripe * test::facing_shade())[0]) <= 1 ? 1 : 0;
  }
  EXPECT_GE(light, 24);
  EXPECT_GE(dark, 24);
  EXPECT_EQ(light + dark, 60);
}

TEST_F(SceneRendererTest, TransparentMeshesHideNothingInAnyOrder) {
  rectangles_.add(-4, -4, 4, 4, 1);
  rectangles_.add(-2, -2, 2, 2, 0);
  rectangles_.add(-4, -4, 4, 4, -1);
  const Look glass{.fill = Look::Fill::kColor, .color = kYellow, .opacity = 0.2},
      red{.fill = Look::Fill::kColor, .color = kRed};
  const Picture picture = draw({glass, red, glass});
  const Pixel lit = test::shaded(kYellow, test::facing_shade()),
              solid = test::shaded(kRed, test::facing_shade());
  Pixel through_one{}, through_two{};
  for (std::size_t i = 0; i < 3; ++i) {
    through_one[i] = static_cast<int>(std::lround(0.8 * solid[i] + 0.2 * lit[i]));
    through_two[i] = static_cast<int>(std::lround(0.64 * 255 + 0.36 * lit[i]));
  }
  EXPECT_THAT(pixel(picture, 50, 50), IsNear(through_one, 2)) << "in front of the red one, not behind it";
  EXPECT_THAT(pixel(picture, 20, 20), IsNear(through_two, 2));
}

TEST_F(SceneRendererTest, PlanarGroupsColorTriangles) {
  if (!device().info().numbers_triangles) GTEST_SKIP() << "the device does not number triangles";
  rectangles_.add(-4, -4, 4, 4, 0);
  rectangles_.add(5, 5, 6, 6, 0);  // its triangles' bytes come second
  const GroupShades groups = shade_groups(std::array{1U, 3U});
  EXPECT_EQ(groups, (GroupShades{0, 255}));
  SceneRenderer renderer(device(), 4);
  const SceneModel with_groups = model(groups), without = model();
  const std::vector<Look> looks(2, {.fill = Look::Fill::kGroups});
  const auto picture_of = [&](const SceneModel& drawn) {
    return renderer.draw(drawn, test::facing_camera(), looks, kSize, kSize);
  };
  const Pixel green = test::shaded({0, 1, 0}, test::facing_shade()),
              red = test::shaded(kRed, test::facing_shade());
  Picture picture = picture_of(with_groups);
  EXPECT_EQ(pixel(picture, 70, 60), green) << "the first triangle, below the diagonal";
  EXPECT_EQ(pixel(picture, 30, 40), red);
  renderer.set_group_colors(ratings::ColorMap::kViridis);
  picture = picture_of(with_groups);
  EXPECT_THAT(pixel(picture, 30, 40),
              IsNear(test::shaded(ratings::color(1, ratings::ColorMap::kViridis), test::facing_shade()), 1));
  picture = picture_of(without);
  EXPECT_EQ(pixel(picture, 30, 40)[0], pixel(picture, 30, 40)[2]) << "unknown groups are grey";
}

TEST_F(SceneRendererTest, FarFromTheEyeTheLightIsTheSame) {
  rectangles_.add(-4, -4, 4, 4, 0);
  for (const double distance : {1e3, 1e6}) {
    const Camera camera{.eye = {0, 0, distance}, .target = {0, 0, 0}, .tangent = 5 / distance};
    const std::vector<Look> looks = {{.fill = Look::Fill::kColor, .color = kRed}};
    const Picture picture = SceneRenderer(device(), 4).draw(model(), camera, looks, kSize, kSize);
    for (std::uint32_t x = 20; x < 80; ++x)
      ASSERT_THAT(pixel(picture, x, 50), IsNear(test::shaded(kRed, test::facing_shade()), 1)) << distance;
  }
}

TEST_F(SceneRendererTest, InstancesShareTheirMesh) {
  rectangles_.add(-0.5, -0.5, 0.5, 0.5, 0);
  mesh::Scene& scene = rectangles_.scene();
  for (const double x : {-3.0, 3.0}) {
    mesh::Instance more = scene.instances.front();
    more.world = {2, 0, 0, x, 0, 1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 1};
    scene.instances.push_back(more);
  }
  const Look red{.fill = Look::Fill::kColor, .color = kRed},
      yellow{.fill = Look::Fill::kColor, .color = kYellow};
  const Picture picture = draw({red, yellow, red});
  EXPECT_EQ(model().triangles(), 2U);
  EXPECT_EQ(pixel(picture, 50, 50), test::shaded(kRed, test::facing_shade()));
  EXPECT_EQ(pixel(picture, 12, 30), test::shaded(kYellow, test::facing_shade()));
  EXPECT_EQ(pixel(picture, 88, 30), test::shaded(kRed, test::facing_shade()));
  EXPECT_EQ(pixel(picture, 8, 30), (Pixel{255, 255, 255}));
}

TEST_F(SceneRendererTest, TheSamePictureTwiceAndEdgesAreSmooth) {
  rectangles_.add(-3.03, -2.07, 1.01, 4.04, 0);
  const std::vector<Look> looks = {{.fill = Look::Fill::kColor, .color = {0, 0, 0}}};
  const Picture smooth = draw(looks), hard = draw(looks, 1);
  EXPECT_EQ(smooth.rgba, draw(looks).rgba);
  const auto between = [](const Picture& picture) {
    return std::ranges::count_if(picture.rgba, [](std::uint8_t byte) { return byte != 0 && byte != 255; });
  };
  EXPECT_EQ(between(hard), 0);
  EXPECT_GT(between(smooth), 100);
}

TEST_F(SceneRendererTest, MeshesAtInfinityAreLeftOut) {
  rectangles_.add(-3, -3, 3, 3, 0);
  rectangles_.add(-3, -3, 3, 3, 0);
  rectangles_.scene().instances[0].world[3] = std::numeric_limits<double>::infinity();
  rectangles_.scene().instances[1].world[0] = std::nan("");
  EXPECT_THAT(draw({{.fill = Look::Fill::kColor}, {.fill = Look::Fill::kColor}}).rgba, Each(255));
}

}  // namespace
}  // namespace scene_analyzer::scene_render
