// The camera as a person moves it: what stays as it is, what is in view, and that nothing breaks it.
#include "viewer/navigation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ratings/ratings.h"

namespace scene_analyzer::viewer {
namespace {

using analysis::Bounds;
using mesh::Vector3;
using scene_render::Camera;
using scene_render::Projected;

const Bounds kRoom = {.min = {-4, 0, -3}, .max = {2, 2.5, 3}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3 difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double length(const Vector3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

Vector3 view_direction(const Navigation& navigation) {
  const Vector3 way = difference(navigation.target(), navigation.eye());
  return {way[0] / length(way), way[1] / length(way), way[2] / length(way)};
}

void expect_near(const Vector3& a, const Vector3& b, double tolerance) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

Navigation in_room(double aspect = 1.5) {
  Navigation navigation;
  navigation.show_all(kRoom, aspect);
  return navigation;
}

// How far the corners reach, as a part of the half window.
double reach(const Navigation& navigation, double aspect, const Bounds& box) {
  double farthest = 0;
  for (const double x : {box.min[0], box.max[0]})
    for (const double y : {box.min[1], box.max[1]})
      for (const double z : {box.min[2], box.max[2]}) {
        const auto place = project(navigation.camera(), aspect, {x, y, z});
        if (!place) return kInfinity;
        farthest = std::max({farthest, std::abs(place->x), std::abs(place->y)});
      }
  return farthest;
}

void expect_sound(const Navigation& navigation) {
  const Camera camera = navigation.camera();
  EXPECT_NE(camera.eye, camera.target);
  EXPECT_EQ(camera.up, (Vector3{0, 1, 0}));
  EXPECT_EQ(camera.middle, (std::array<double, 2>{0, 0}));
  EXPECT_NEAR(camera.tangent, std::tan(std::acos(-1) / 8), 1e-12);
  EXPECT_GT(navigation.distance(), 0);
  for (const double entry : view_matrix(camera)) ASSERT_TRUE(std::isfinite(entry));
  // The target is in the middle, at distance 1: nothing was lost to rounding.
  const auto place = project(camera, 1, camera.target);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 0, 1e-5);
  EXPECT_NEAR(place->y, 0, 1e-5);
}

TEST(Navigation, AGrowingSceneLeavesTheViewWhereItIs) {
  Navigation navigation;
  navigation.show_all({.min = {0, 0, 0}, .max = {1, 1, 1}}, 1);
  navigation.orbit(0.1, 0.1);
  const mesh::Vector3 eye = navigation.eye(), target = navigation.target();
  navigation.extend({.min = {-100, -100, -100}, .max = {100, 100, 100}});
  EXPECT_EQ(navigation.eye(), eye);
  EXPECT_EQ(navigation.target(), target);
  navigation.scale(1e-9);  // as far away as the larger scene allows
  EXPECT_GT(navigation.distance(), 1e5);
}

TEST(Navigation, ShowsTheWholeScene) {
  const Bounds flat = {.min = {-50, 0, -1}, .max = {50, 0, 1}}, tall = {.min = {0, 0, 0}, .max = {1, 90, 1}};
  for (const double aspect : {0.1, 0.4, 1.0, 1.9, 7.0})
    for (const Bounds& scene : {kRoom, flat, tall}) {
      Navigation navigation;
      navigation.show_all(scene, aspect);
      const double farthest = reach(navigation, aspect, scene);
      EXPECT_LE(farthest, 1);
      EXPECT_GT(farthest, 0.3) << "and not much more than the scene";
      expect_sound(navigation);
    }
}

TEST(Navigation, StartsFromTheDirectionOfTheDefaultEye) {
  const Navigation navigation = in_room();
  const Vector3 from = difference(ratings::default_eye(kRoom), {-1, 1.25, 0});
  const Vector3 direction = view_direction(navigation);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(direction[axis], -from[axis] / length(from), 1e-12);
  expect_near(navigation.target(), {-1, 1.25, 0}, 1e-12);
}

TEST(Navigation, FramingKeepsTheDirection) {
  for (const double aspect : {0.3, 1.0, 4.0}) {
    Navigation navigation = in_room(aspect);
    navigation.orbit(0.3, -0.4);
    const Vector3 before = view_direction(navigation);
    const Bounds cup = {.min = {1, 1, 1}, .max = {1.1, 1.2, 1.1}};
    navigation.frame(cup, aspect);
    expect_near(view_direction(navigation), before, 1e-9);
    EXPECT_LE(reach(navigation, aspect, cup), 1);
    EXPECT_GT(reach(navigation, aspect, cup), 0.3);
    navigation.frame({.min = {1, 1, 1}, .max = {1, 1, 1}}, aspect);
    expect_near(navigation.target(), {1, 1, 1}, 1e-12);
    expect_sound(navigation);
  }
}

TEST(Navigation, OrbitingKeepsTheDistanceAndTheTarget) {
  Navigation navigation = in_room();
  const double distance = navigation.distance();
  const Vector3 target = navigation.target();
  for (int i = 0; i < 100; ++i) {
    navigation.orbit(0.037 * i, 0.4 * std::sin(i));
    EXPECT_NEAR(length(difference(navigation.eye(), target)), distance, 1e-9 * distance);
    EXPECT_EQ(navigation.target(), target);
  }
}

TEST(Navigation, AWindowsHeightIsHalfATurn) {
  Navigation navigation = in_room();
  const Vector3 before = view_direction(navigation);
  navigation.orbit(1, 0);
  expect_near(view_direction(navigation), {-before[0], before[1], -before[2]}, 1e-9);
  navigation.orbit(-1, 0);
  expect_near(view_direction(navigation), before, 1e-9);
}

TEST(Navigation, TheSceneTurnsWithThePointer) {
  Navigation navigation = in_room();
  // A point between eye and target, whichever way the pointer goes.
  const auto place_of_near_point = [&](double right, double down) {
    Navigation turned = navigation;
    const Vector3 direction = view_direction(navigation);
    Vector3 near_point = navigation.target();
    for (std::size_t axis = 0; axis < 3; ++axis) near_point[axis] -= direction[axis];
    turned.orbit(right, down);
    return project(turned.camera(), 1.5, near_point).value();
  };
  EXPECT_GT(place_of_near_point(0.1, 0).x, 0.01);
  EXPECT_LT(place_of_near_point(-0.1, 0).x, -0.01);
  EXPECT_LT(place_of_near_point(0, 0.1).y, -0.01) << "down";
  EXPECT_GT(place_of_near_point(0, -0.1).y, 0.01);
}

TEST(Navigation, NeverOverThePoles) {
  for (const double down : {0.01, 5.0, -0.01, -5.0, 1e300}) {
    Navigation navigation = in_room();
    const Vector3 before = view_direction(navigation);
    for (int i = 0; i < 200; ++i) navigation.orbit(0, down);
    EXPECT_EQ(view_direction(navigation)[1]<0, down> 0) << "from above after dragging down";
    EXPECT_LT(std::abs(view_direction(navigation)[1]), 1);
    EXPECT_GT(view_direction(navigation)[0] * before[0], 0) << "still on the same side";
    expect_sound(navigation);
  }
}

TEST(Navigation, PanningKeepsTheDirectionAndFollowsThePointer) {
  Navigation navigation = in_room();
  const Vector3 direction = view_direction(navigation), target = navigation.target();
  const double distance = navigation.distance();
  navigation.pan(0.25, 0.125);
  expect_near(view_direction(navigation), direction, 1e-12);
  EXPECT_EQ(navigation.distance(), distance);
  const auto place = project(navigation.camera(), 1.5, target);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x * 1.5, 0.5, 1e-9) << "half heights";
  EXPECT_NEAR(place->y, -0.25, 1e-9);
  navigation.pan(-0.25, -0.125);
  expect_near(navigation.target(), target, 1e-9);
}

TEST(Navigation, ZoomingGoesTowardsTheTargetAndNeverThroughIt) {
  Navigation navigation = in_room();
  const Vector3 direction = view_direction(navigation), target = navigation.target();
  const double distance = navigation.distance();
  navigation.zoom(1);
  EXPECT_NEAR(navigation.distance(), 0.9 * distance, 1e-9);
  navigation.zoom(-1);
  EXPECT_NEAR(navigation.distance(), distance, 1e-9);
  for (const double steps : {1.0, 1000.0, 1e300, -1.0, -1000.0, -1e300}) {
    for (int i = 0; i < 1000; ++i) navigation.zoom(steps);
    EXPECT_EQ(navigation.target(), target);
    expect_near(view_direction(navigation), direction, 1e-5);
    expect_sound(navigation);
  }
}

TEST(Navigation, ScalingTheSceneIsTheEyeComingNearer) {
  Navigation navigation = in_room();
  const Vector3 target = navigation.target();
  const Vector3 point = {1, 2, -1};
  Vector3 grown{};
  for (std::size_t axis = 0; axis < 3; ++axis) grown[axis] = target[axis] + 3 * (point[axis] - target[axis]);
  const auto of_grown_scene = project(navigation.camera(), 1.5, grown);
  navigation.scale(3);
  const auto of_nearer_eye = project(navigation.camera(), 1.5, point);
  ASSERT_TRUE(of_grown_scene && of_nearer_eye);
  EXPECT_NEAR(of_grown_scene->x, of_nearer_eye->x, 1e-9);
  EXPECT_NEAR(of_grown_scene->y, of_nearer_eye->y, 1e-9);
  for (const double factor : {0.0, kInfinity, -1.0, std::nan("")}) {
    navigation.scale(factor);
    expect_sound(navigation);
  }
}

TEST(Navigation, MovingTakesEyeAndTarget) {
  const Navigation before = in_room();
  const double distance = before.distance();
  const Vector3 direction = view_direction(before);
  const auto way = [&](double right, double up, double forward) {
    Navigation after = before;
    after.move(right, up, forward);
    expect_near(view_direction(after), direction, 1e-9);
    EXPECT_EQ(after.distance(), distance);
    return difference(after.eye(), before.eye());
  };
  expect_near(way(0, 0.5, 0), {0, distance / 2, 0}, 1e-9);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(way(0, 0, 0.5)[axis], direction[axis] * distance / 2, 1e-9);
  const Vector3 right = way(1, 0, 0);
  EXPECT_NEAR(length(right), distance, 1e-9);
  EXPECT_NEAR(right[1], 0, 1e-9);
  Vector3 beside = before.target();
  for (std::size_t axis = 0; axis < 3; ++axis) beside[axis] += right[axis] / 10;
  EXPECT_GT(project(before.camera(), 1, beside)->x, 0);
}

TEST(Navigation, WhereEyeAndTargetMeetMovingStillMoves) {
  Navigation navigation = in_room();
  navigation.zoom(1e300);
  const Vector3 before = navigation.eye();
  navigation.move(0, 0, 1);
  EXPECT_GT(length(difference(navigation.eye(), before)), 0.05);
}

TEST(Navigation, HeldKeysGoBySeconds) {
  Navigation at_once = in_room(), in_steps = in_room();
  const Motion motion = {.right = 1, .up = -1, .forward = 1, .scale = 0};
  at_once.advance(motion, 1);
  for (int i = 0; i < 50; ++i) in_steps.advance(motion, 0.02);
  expect_near(at_once.eye(), in_steps.eye(), 1e-9);
  EXPECT_GT(length(difference(at_once.eye(), in_room().eye())), 0.5 * at_once.distance());

  Navigation larger = in_room();
  for (int i = 0; i < 50; ++i) larger.advance({.scale = 1}, 0.02);
  EXPECT_NEAR(larger.distance(), in_room().distance() / 2, 1e-9);
  Navigation still = in_room();
  still.advance(motion, 0);
  still.advance(motion, -1);
  still.advance({}, 10);
  EXPECT_EQ(still.eye(), in_room().eye());
}

TEST(Navigation, ScenesOfAnySizeFeelAlike) {
  const auto seen = [](double size) {
    Navigation navigation;
    navigation.show_all({.min = {-size, 0, -size}, .max = {size, size, 2 * size}}, 1.3);
    navigation.orbit(0.2, 0.1);
    navigation.move(0.1, 0.2, 0.3);
    navigation.zoom(3);
    navigation.pan(0.1, -0.2);
    return project(navigation.camera(), 1.3, {size, size, size}).value();
  };
  for (const double size : {1e-30, 1e-3, 1e6, 1e30}) {
    EXPECT_NEAR(seen(size).x, seen(1).x, 1e-9);
    EXPECT_NEAR(seen(size).y, seen(1).y, 1e-9);
  }
}

TEST(Navigation, NoSceneAndNoAmountBreaksIt) {
  const double largest = std::numeric_limits<double>::max();
  const Bounds scenes[] = {kRoom,
                           {.min = {0, 0, 0}, .max = {0, 0, 0}},
                           {.min = {7, -3, 1e6}, .max = {7, -3, 1e6}},
                           {.min = {1e30, 1e30, 1e30}, .max = {1e30, 1e30, 1e30}},
                           {.min = {-1e30, -1e30, -1e30}, .max = {1e30, 1e30, 1e30}},
                           {.min = {0, 0, 0}, .max = {1e-30, 1e-30, 1e-30}},
                           {.min = {1, 1, 1}, .max = {1 + 1e-15, 1, 1}},
                           {.min = {0, 0, 0}, .max = {5e-324, 0, 0}},
                           {.min = {-largest, -largest, -largest}, .max = {largest, largest, largest}},
                           {.min = {-kInfinity, 0, std::nan("")}, .max = {kInfinity, 0, std::nan("")}},
                           {.min = {1, 1, 1}, .max = {-1, -1, -1}}};
  const double amounts[] = {0, 0.1, -0.7, 3, 1e9, -1e300, largest, kInfinity, -kInfinity, std::nan("")};
  std::mt19937 random(7);
  const auto amount = [&] { return amounts[random() % std::size(amounts)]; };
  for (const Bounds& scene : scenes) {
    Navigation navigation;
    navigation.show_all(scene, amount());
    expect_sound(navigation);
    for (int i = 0; i < 300; ++i) {
      navigation.orbit(amount(), amount());
      navigation.pan(amount(), amount());
      navigation.zoom(amount());
      navigation.move(amount(), amount(), amount());
      navigation.scale(amount());
      navigation.advance({.right = amount(), .up = amount(), .forward = amount(), .scale = amount()},
                         amount());
      if (i % 50 == 0) navigation.frame(scenes[random() % std::size(scenes)], amount());
      expect_sound(navigation);
    }
  }
}

TEST(Navigation, NobodyGetsLost) {
  Navigation navigation = in_room();
  for (int i = 0; i < 100000; ++i) navigation.move(1, 1, 1);
  EXPECT_LT(length(difference(navigation.target(), {-1, 1.25, 0})), 3e4);
  navigation.show_all(kRoom, 1.5);
  EXPECT_EQ(navigation.eye(), in_room().eye());
}

}  // namespace
}  // namespace scene_analyzer::viewer
