// mouse.h — What the mouse does in the scene: turn, shift, zoom, and choose.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "viewer/navigation.h"

namespace scene_analyzer::viewer {

// Between ImGui's begin of a frame and its end: moves the camera as the mouse was moved since the last frame.
// Returns the pixel where it clicked, from the upper left corner, if it did. What happens over a panel is the
// panel's.
std::optional<std::pair<std::uint32_t, std::uint32_t>> follow_mouse(Navigation& navigation);

}  // namespace scene_analyzer::viewer
