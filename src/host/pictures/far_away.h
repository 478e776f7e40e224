// far_away.h — A mesh so far from all others that a picture of everything shows next to nothing.
#pragma once

#include <optional>

#include "scene_render/scene_model.h"

namespace scene_analyzer::pictures {

struct FarAway {
  std::size_t mesh = 0;    // the farthest
  mesh::Vector3 others{};  // the middle of the others, by coordinate the median
  mesh::Vector3 eye{};     // from where these can be seen: the direction of ratings::default_eye()
};
// Of a scene more than 1000 times as large as half of its meshes and the distances of these from their
// middle. Cost: linear.
std::optional<FarAway> find_far_away(const scene_render::SceneModel& model);

}  // namespace scene_analyzer::pictures
