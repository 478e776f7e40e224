// glb_placement.h — A matrix as the translation, rotation and scale of a glTF node, and what is left of it
// for the positions.
//
// glTF allows a node's `matrix` as well, but only one that is a product of these three. Checkers and viewers
// take it apart in 32-bit floats and refuse good ones whose scale is a few hundred.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "mesh/scene.h"

namespace scene_analyzer::report {

// p -> translation + rotation(scale * (baked p)).
struct Placement {
  mesh::Vector3 translation{};
  std::array<double, 4> rotation = {0, 0, 0, 1};  // unit quaternion x, y, z, w; w >= 0
  mesh::Vector3 scale = {1, 1, 1};                // none is 0
  // To be applied to the positions; never mirrors, so that triangles keep their winding.
  mesh::Matrix3 baked = mesh::kIdentity3;
};

// Axes of `world` whose angles are right ones up to 1e-6 are turned and scaled, others are baked. Absent when
// its first three rows are not finite or beyond 32-bit floats; the last one is taken as 0 0 0 1.
std::optional<Placement> place(const mesh::Matrix4& world);

// What sets an asset upright in metres: quarter turns from "+Z", "-X", ... up to +Y, and `unit_scale` metres
// per unit. Nothing where nothing, or no usable value, is stated.
Placement upright(const std::optional<std::string>& up_axis, const std::optional<double>& unit_scale);

}  // namespace scene_analyzer::report
