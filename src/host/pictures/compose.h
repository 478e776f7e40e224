// compose.h — View of a scene and legend, together as a PNG file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "pictures/legend.h"
#include "pictures/marks.h"
#include "scene_render/picture.h"

namespace scene_analyzer::pictures {

// Of a picture of `width` x `height` pixels, how many rows at the bottom the legend takes; the view has those
// above.
std::uint32_t legend_height(std::uint32_t width, std::uint32_t height);

// Of the rings around small meshes, in pixels.
double mark_radius(std::uint32_t width, std::uint32_t height);

// The bytes of a PNG file as wide as the view, the legend below it; deterministic with one installation of
// fonts. Throws std::bad_alloc, and std::runtime_error with Cairo's reason. Memory: twice the pixels, 4 bytes
// each. Compressing takes seconds for 100 million pixels: `look` is called meanwhile, and what it throws ends
// it.
std::string compose(const scene_render::Picture& view, std::span<const Mark> marks, const Legend& legend,
                    std::uint32_t height, const std::function<void()>& look = {});

}  // namespace scene_analyzer::pictures
