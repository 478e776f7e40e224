// The camera: what it shows, and where in the picture.
#include "scene_render/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ratings/ratings.h"

namespace scene_analyzer::scene_render {
namespace {

using mesh::Vector3;

const analysis::Bounds kRoom = {.min = {-4, 0, -3}, .max = {2, 2.5, 3}};

std::vector<Projected> corners(const Camera& camera, double aspect, const analysis::Bounds& scene) {
  std::vector<Projected> result;
  for (const double x : {scene.min[0], scene.max[0]})
    for (const double y : {scene.min[1], scene.max[1]})
      for (const double z : {scene.min[2], scene.max[2]})
        if (const auto place = project(camera, aspect, {x, y, z})) result.push_back(*place);
  return result;
}

TEST(Camera, ShowsTheWholeSceneInTheMiddle) {
  for (const double aspect : {0.4, 1.0, 1.9, 7.0})
    for (const std::optional<Vector3>& eye : {std::optional<Vector3>(), std::optional<Vector3>({30, 1, 2}),
                                              std::optional<Vector3>({-9, 8, -20})}) {
      const Camera camera = make_camera(kRoom, eye, {}, aspect);
      EXPECT_EQ(camera.eye, eye.value_or(ratings::default_eye(kRoom)));
      const std::vector<Projected> seen = corners(camera, aspect, kRoom);
      ASSERT_EQ(seen.size(), 8U);
      const auto [left, right] = std::ranges::minmax(seen, {}, &Projected::x);
      const auto [low, high] = std::ranges::minmax(seen, {}, &Projected::y);
      EXPECT_NEAR(left.x, -right.x, 1e-9);
      EXPECT_NEAR(low.y, -high.y, 1e-9);
      EXPECT_NEAR(std::max(right.x, high.y), 1 / 1.06, 1e-9) << "fills the picture but for a margin";
    }
}

TEST(Camera, FromWithinTheSceneItLooksToItsMiddle) {
  const Camera camera = make_camera(kRoom, Vector3{-3, 1, 2}, {}, 1.5);
  EXPECT_NEAR(camera.tangent, std::tan(std::acos(-1) / 6), 1e-12);
  const auto middle = project(camera, 1.5, {-1, 1.25, 0});
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 0, 1e-12);
  EXPECT_NEAR(middle->y, 0, 1e-12);
  EXPECT_FALSE(project(camera, 1.5, {-5, 1, 4})) << "behind the eye";
}

TEST(Camera, WithATargetTheFieldOfViewIsFixed) {
  const Camera camera = make_camera(kRoom, Vector3{0, 0, 10}, Vector3{0, 0, 0}, 2);
  const double tangent = std::tan(std::acos(-1) / 8);
  const auto up = project(camera, 2, {0, 10 * tangent, 0}), right = project(camera, 2, {20 * tangent, 0, 0});
  EXPECT_NEAR(up->y, 1, 1e-12);
  EXPECT_NEAR(right->x, 1, 1e-12);
  EXPECT_NEAR(up->x, 0, 1e-12);
  EXPECT_NEAR(up->unit, 1 / (10 * tangent), 1e-12);
  const auto nearer = project(camera, 2, {0, 0, 5});
  EXPECT_NEAR(nearer->unit, 2 * up->unit, 1e-12);
}

TEST(Camera, TargetsAreDirections) {
  const Vector3 eye = {3, 1.2, 1.5};
  for (const double length : {1e-6, 1.0, 1e6}) {
    const Camera camera = make_camera(kRoom, eye, Vector3{3 - 4 * length, 1.2, 1.5 - 3 * length}, 1);
    const auto place = project(camera, 1, {3 - 4, 1.2, 1.5 - 3});
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x, 0, 1e-6);
    EXPECT_NEAR(place->y, 0, 1e-6);
    EXPECT_NEAR(place->unit, 1 / (5 * camera.tangent), 1e-6);
  }
}

TEST(Camera, UpAndDownAndNowhereAreDirectionsToo) {
  for (const double y : {10.0, -10.0}) {
    const Camera camera = make_camera(kRoom, Vector3{0, y, 0}, Vector3{0, 0, 0}, 1);
    const auto place = project(camera, 1, {1, 0, 0});
    ASSERT_TRUE(place);
    EXPECT_NEAR(std::abs(place->x), place->unit, 1e-9);
    EXPECT_NEAR(place->y, 0, 1e-9);
  }
  const analysis::Bounds point = {.min = {3, 3, 3}, .max = {3, 3, 3}};
  for (const std::optional<Vector3>& eye : {std::optional<Vector3>(), std::optional<Vector3>({3, 3, 3})}) {
    const std::array<double, 12> view = view_matrix(make_camera(point, eye, {}, 1));
    EXPECT_TRUE(std::ranges::all_of(view, [](double entry) { return std::isfinite(entry); }));
  }
}

TEST(Camera, TheViewIsRightHandedAndKeepsLengths) {
  const Camera camera = make_camera(kRoom, Vector3{3, 4, 5}, Vector3{-1, 0, 1}, 1);
  const std::array<double, 12> view = view_matrix(camera);
  const double distance = std::hypot(camera.target[0] - 3, camera.target[1] - 4, camera.target[2] - 5);
  double product[3][3];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      product[a][b] = 0;
      for (std::size_t i = 0; i < 3; ++i)
        product[a][b] += view[4 * a + i] * view[4 * b + i] * distance * distance;
      EXPECT_NEAR(product[a][b], a == b ? 1 : 0, 1e-12);
    }
  const double determinant = view[0] * (view[5] * view[10] - view[6] * view[9]) -
                             view[1] * (view[4] * view[10] - view[6] * view[8]) +
                             view[2] * (view[4] * view[9] - view[5] * view[8]);
  EXPECT_GT(determinant, 0);
  EXPECT_NEAR(
      view[8] * camera.target[0] + view[9] * camera.target[1] + view[10] * camera.target[2] + view[11], -1,
      1e-12)
      << "the target is at distance 1";
}

}  // namespace
}  // namespace scene_analyzer::scene_render
