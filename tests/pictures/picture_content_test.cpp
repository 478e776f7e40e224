// What a picture shows: values, colours, extremes, marks and the words of the legend.
#include "pictures/picture_content.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pictures/legend.h"
#include "pictures/marks.h"
#include "rated_scene.h"

namespace scene_analyzer::pictures {
namespace {

using scene_render::Look;
using test::rated;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Content kDensity = {.subject = Subject::kMetric, .metric = analysis::Metric::kRelativeDensity};

TEST(PictureContent, MetricsAreShownInTheirOwnRange) {
  const ratings::SceneRating rating = rated({-1.0, 0.5, std::nullopt});
  EXPECT_THAT(values(kDensity, rating), ElementsAre(-1.0, 0.5, std::nullopt));
  EXPECT_TRUE(is_signed(kDensity, rating));
  const std::vector<Look> shown = looks(kDensity, rating);
  EXPECT_EQ(shown[0].fill, Look::Fill::kColor);
  EXPECT_EQ(shown[0].color, (ratings::Rgb{0, 0, 1}));
  EXPECT_EQ(shown[1].color, (ratings::Rgb{1, 1, 0}));
  EXPECT_EQ(shown[2].fill, Look::Fill::kNoValue);
  EXPECT_EQ(shown[0].opacity, 1);
  Content viridis = kDensity;
  viridis.map = ratings::ColorMap::kViridis;
  EXPECT_EQ(looks(viridis, rating)[0].color, ratings::color(-1, ratings::ColorMap::kViridis, true));
}

TEST(PictureContent, RelativeMetricsAndAggregates) {
  ratings::SceneRating rating = rated({-1.0, 0.5});
  Content content = kDensity;
  content.relative = true;
  EXPECT_THAT(values(content, rating), ElementsAre(-0.5, 0.25));
  content = {.subject = Subject::kAggregate};
  EXPECT_THAT(values(content, rating), ElementsAre(1.0, 0.5));
  EXPECT_FALSE(is_signed(content, rating));
  rating.signed_aggregate = true;
  EXPECT_TRUE(is_signed(content, rating));
}

TEST(PictureContent, TheUpperQuarterIsExtreme) {
  EXPECT_EQ(least_extreme({0.0, std::nullopt, 1.0}), 0.75);
  EXPECT_EQ(least_extreme({-1.0, 1.0}), 0.5);
  EXPECT_EQ(least_extreme({0.3}), 0.3);
  EXPECT_EQ(least_extreme({std::nullopt}), std::nullopt);
  Content content = kDensity;
  content.emphasize_extremes = true;
  const std::vector<Look> shown = looks(content, rated({0.0, 0.74, 0.76, 1.0, std::nullopt}));
  EXPECT_LT(shown[0].opacity, 0.5);
  EXPECT_LT(shown[1].opacity, 0.5);
  EXPECT_EQ(shown[2].opacity, 1);
  EXPECT_EQ(shown[3].opacity, 1);
  EXPECT_LT(shown[4].opacity, 0.5);
  for (const Look& look : looks(content, rated({0.2, 0.2}))) EXPECT_EQ(look.opacity, 1) << "all alike";
}

TEST(PictureContent, GroupsAndOwnColorsNeedNoValues) {
  const ratings::SceneRating rating = rated({std::nullopt, 1.0});
  for (const Look& look : looks({.subject = Subject::kPlanarGroups}, rating))
    EXPECT_EQ(look.fill, Look::Fill::kGroups);
  for (const Look& look : looks({.subject = Subject::kOwnColors}, rating))
    EXPECT_EQ(look.fill, Look::Fill::kOwnColor);
}

TEST(Legend, NamesTheMetricItsRangeAndTheScene) {
  const Legend legend = make_legend(kDensity, rated({-0.25, 1.0, std::nullopt}), "room.glb");
  EXPECT_EQ(legend.title, "Relative density");
  EXPECT_THAT(legend.lines,
              ElementsAre("absolute, -0.25 to 1 in this scene", "room.glb: 3 meshes, 3,000 triangles"));
  EXPECT_TRUE(legend.without_value);
  EXPECT_EQ(legend.present, std::pair(0.375, 1.0));
  EXPECT_EQ(legend.ticks.front(), std::pair(0.0, std::string("-1")));
  EXPECT_EQ(legend.ticks.back(), std::pair(1.0, std::string("1")));
  EXPECT_EQ(legend.bar(0.5), ratings::color(0, ratings::ColorMap::kThesis, true));

  Content content = {.subject = Subject::kAggregate, .relative = true, .emphasize_extremes = true};
  const Legend aggregate = make_legend(content, rated({0.0, 1.0}), "a");
  EXPECT_THAT(aggregate.lines[0], HasSubstr("relative, 0 to 1 in this scene; below 0.75 transparent"));
  EXPECT_FALSE(aggregate.without_value);
  EXPECT_EQ(aggregate.ticks.front().second, "0");
  EXPECT_EQ(aggregate.bar(0), ratings::color(0));

  const Legend missing = make_legend(kDensity, rated({std::nullopt}), "a");
  EXPECT_EQ(missing.present, std::nullopt);
  EXPECT_THAT(missing.lines, ElementsAre("absolute", "a: 1 mesh, 1,000 triangles"));

  const Legend groups = make_legend({.subject = Subject::kPlanarGroups}, rated({1.0}), "a");
  EXPECT_EQ(groups.bar(1), (ratings::Rgb{1, 0, 0}));
  EXPECT_FALSE(make_legend({.subject = Subject::kOwnColors}, rated({1.0}), "a").bar);
}

TEST(Legend, CoolwarmShowsItsUpperHalfForRatings) {
  Content content = {.subject = Subject::kAggregate, .map = ratings::ColorMap::kCoolwarm};
  const Legend legend = make_legend(content, rated({0.0, 1.0}), "a");
  EXPECT_EQ(legend.bar(0), ratings::color(0, ratings::ColorMap::kCoolwarm));
}

TEST(Marks, SmallExtremeMeshesHaveRings) {
  analysis::AssetAnalysis asset;
  for (const double x : {0.0, 10.0, 20.0, 30.0, 1000.0})
    asset.instances.push_back({.geometry = 0,
                               .node = "",
                               .mesh = "mesh " + std::to_string(static_cast<int>(x)),
                               .bounds = analysis::Bounds{{x, 0, 0}, {x + 1, 1, 1}}});
  asset.instances[1].bounds->max = {15, 5, 5};
  const ratings::SceneRating rating = rated({1.0, 0.9, 0.1, 0.95, 1.0});
  const scene_render::Camera camera{.eye = {0.5, 0.5, 100.5}, .target = {0.5, 0.5, 0.5}, .tangent = 0.5};
  Content content = kDensity;
  EXPECT_THAT(mark_small_extremes(content, rating, {&asset, 1}, camera, 200, 100, 3), IsEmpty());
  content.emphasize_extremes = true;
  const std::vector<Mark> marks = mark_small_extremes(content, rating, {&asset, 1}, camera, 200, 100, 3);
  ASSERT_EQ(marks.size(), 2U) << "one is large, one not extreme, one out of sight";
  EXPECT_EQ(marks[0].name, "mesh 0");
  EXPECT_NEAR(marks[0].x, 100, 1e-9);
  EXPECT_NEAR(marks[0].y, 50, 1e-9);
  EXPECT_EQ(marks[1].name, "mesh 30");
  EXPECT_NEAR(marks[1].x, 130, 1e-9);
}

TEST(Marks, ManyHaveNoNamesAndTooManyAreCut) {
  analysis::AssetAnalysis asset;
  asset.instances.assign(
      500, {.geometry = 0, .node = "n", .mesh = "m", .bounds = analysis::Bounds{{0, 0, 0}, {1, 1, 1}}});
  const scene_render::Camera camera{.eye = {0, 0, 100}, .target = {0, 0, 0}, .tangent = 0.5};
  Content content = kDensity;
  content.emphasize_extremes = true;
  const ratings::SceneRating rating = rated(std::vector<std::optional<double>>(500, 1.0));
  const std::vector<Mark> marks = mark_small_extremes(content, rating, {&asset, 1}, camera, 200, 100, 3);
  ASSERT_EQ(marks.size(), 100U);
  EXPECT_EQ(marks[0].name, "");
}

}  // namespace
}  // namespace scene_analyzer::pictures
