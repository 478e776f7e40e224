// svg.h — What the report's pictures are made of; UTF-8, deterministic.
#pragma once

#include <cstdint>
#include <string>

namespace scene_analyzer::report {

// The opening tag of a picture of that many units, on white, with `title` in bold at its top, from `left` on.
// Any text is good for a title, also what XML or a terminal would not like; a long one is shortened.
std::string svg_head(std::uint32_t width, std::uint32_t height, std::uint32_t left, const std::string& title);

// `anchor`: "start", "middle" or "end". Text is ours: nothing is escaped.
void append_text(std::string& out, double x, double y, const char* anchor, const std::string& text,
                 const char* more = "");

// The same, reading upwards.
void append_upright(std::string& out, double x, double y, const char* anchor, const std::string& text);

}  // namespace scene_analyzer::report
