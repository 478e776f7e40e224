// camera.h — Where a scene is seen from.
#pragma once

#include <array>
#include <optional>

#include "analysis/analysis.h"
#include "mesh/scene.h"

namespace scene_analyzer::scene_render {

struct Camera {
  mesh::Vector3 eye{}, target{};  // world, not equal
  mesh::Vector3 up = {0, 1, 0};   // need not be at right angles to the view; of length 1
  double tangent = 0.5;           // of half the vertical field of view
  // What the middle of the picture shows, at distance 1 in the view: (0, 0) is the target.
  std::array<double, 2> middle{};
};

// What the picture of a scene is taken with. Without `eye`: from ratings::default_eye(), the whole scene in
// the middle of the picture. With `eye` alone: the same, or 60 degrees towards the middle of the scene where
// that does not show all of it. With `target`: a field of view of 45 degrees. `aspect` is width / height.
// Where eye and target are one point, the camera looks along -z; else the target is a direction only.
Camera make_camera(const analysis::Bounds& scene, const std::optional<mesh::Vector3>& eye,
                   const std::optional<mesh::Vector3>& target, double aspect);

// The view that a camera has: x to the right, y up, looking along -z, in units of the distance from eye to
// target. Row-major 3 x 4.
std::array<double, 12> view_matrix(const Camera& camera);

// Where in the picture a point of the world is.
struct Projected {
  double x = 0, y = 0;  // -1 at the left and lower edge, 1 at the right and upper one
  double unit = 0;      // how long a unit of the world is there, in half heights of the picture
};
// Nothing for what is not in front of the eye.
std::optional<Projected> project(const Camera& camera, double aspect, const mesh::Vector3& point);

}  // namespace scene_analyzer::scene_render
