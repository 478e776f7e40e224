// text.h — Names out of files made safe to show and to store.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scene_analyzer::import {

inline constexpr std::size_t kLongestName = 1024;  // bytes

// Valid UTF-8 on one line: bytes that are not UTF-8 become U+FFFD, control characters and the marks that
// reorder text are left out, and what goes beyond `longest` bytes is cut between characters and ended with
// "...".
std::string clean_text(std::string_view text, std::size_t longest = kLongestName);

}  // namespace scene_analyzer::import
