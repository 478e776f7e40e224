// glb_arrays.h — The binary part of an exported scene.
#pragma once

#include <string>

#include "report/glb_layout.h"

namespace scene_analyzer::report {

// Appends layout.bytes bytes, little-endian whatever the machine. Memory: none where `out` has reserved them.
void append_arrays(std::string& out, const GlbLayout& layout);

void append_word(std::string& out, std::uint32_t value);

// COLOR_0 of a channel: linear, normalised to 16 bits.
std::uint16_t to_linear(std::uint8_t srgb);

}  // namespace scene_analyzer::report
