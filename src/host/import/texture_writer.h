// texture_writer.h — Base colour textures -> the worker's answer, decoded on the way where that is asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/appearance.h"
#include "import/import.h"
#include "import/wire.h"

namespace scene_analyzer::import {

// Of decoded textures: one image, named a thousand times, must not fill the machine's memory.
inline constexpr std::uint64_t kMostTextureBytes = std::uint64_t{2} << 30;

// The "textures" of scene_wire.h. What cannot be decoded, or comes after `most_bytes` of pixels, becomes one
// warning and no pixels; missing files, which have theirs already, only no pixels. One image at a time is in
// memory (see decode_image). Throws what the writer throws.
void write_textures(const Appearance& appearance, Textures textures, std::vector<std::string>& warnings,
                    wire::Writer& writer, std::uint64_t most_bytes = kMostTextureBytes);

}  // namespace scene_analyzer::import
