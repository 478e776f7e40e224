// navigation.h — The camera as a person moves it: around a target, always with +Y up. No GPU, no window.
//
// Whatever is done, the camera is finite, its eye is not its target, and it looks neither straight up nor
// straight down. Coordinates are world units; those beyond 1e150 are cut to that.
//
// Amounts are relative, so that a scene of millimetres and one of light years feel alike: fractions of the
// window's height for the pointer, the distance from eye to target for everything else. Every function takes
// constant time, and amounts that are no finite numbers do nothing.
#pragma once

#include "analysis/analysis.h"
#include "mesh/scene.h"
#include "scene_render/camera.h"

namespace scene_analyzer::viewer {

// What moves while keys are held, each in [-1,1].
struct Motion {
  double right = 0, up = 0, forward = 0;
  double scale = 0;  // 1: the scene becomes larger
  bool operator==(const Motion&) const = default;
};

class Navigation {
 public:
  // Shows a box of size 2 around the origin.
  Navigation();

  // The whole box is in view, from the direction of ratings::default_eye(), and counts as the scene from now
  // on: its size limits how far away the target and the eye may go (1000 times its diagonal). `aspect` is the
  // window's width / height, cut to 0.01 to 100.
  void show_all(const analysis::Bounds& scene, double aspect);
  // The scene has grown to this box: the limits follow, the view stays.
  void extend(const analysis::Bounds& scene);
  // The whole box, a part of the scene, is in view, from the direction that the camera has.
  void frame(const analysis::Bounds& box, double aspect);

  // The pointer went `right` and `down`, in fractions of the window's height: the scene turns with it about
  // the target, 180 degrees per height; over the poles it does not.
  void orbit(double right, double down);
  // The same, but what is at the target follows the pointer.
  void pan(double right, double down);
  // Towards the target for steps > 0, 10 % of the distance each; never through it.
  void zoom(double steps);
  // Eye and target together, in units of their distance or, where they are very near each other, of 1 % of
  // the scene's diagonal: to the right in the picture, up along +Y, and along the view.
  void move(double right, double up, double forward);
  // The scene looks larger by `factor` > 0. That is the eye coming nearer to the target by it, and is done
  // so: a scene that grows by f about the target and an eye that goes to 1 / f of its distance give the same
  // picture. Distances such as R_d are measured from that eye in the scene's own units.
  void scale(double factor);
  // What `motion` does in `seconds`: in one second 0.8 distances, or twice the size.
  void advance(const Motion& motion, double seconds);

  mesh::Vector3 eye() const;
  const mesh::Vector3& target() const { return target_; }
  double distance() const { return distance_; }

  // A vertical field of view of 45 degrees; Camera::middle is 0.
  scene_render::Camera camera() const;

 private:
  struct Axes {
    mesh::Vector3 right, up, back;  // of the picture, in the world; of length 1
  };
  Axes axes() const;
  void fit(const analysis::Bounds& box, double aspect);
  void shift(const mesh::Vector3& direction, double amount);
  void keep_within_limits();

  mesh::Vector3 scene_middle_{}, target_{};
  double scene_size_ = 1;  // diagonal; > 0, and not too small for its coordinates
  double distance_ = 1;    // from eye to target
  double azimuth_ = 0;     // radians; 0 is seen from +Z, pi / 2 from +X
  double elevation_ = 0;   // radians above the horizon
};

}  // namespace scene_analyzer::viewer
