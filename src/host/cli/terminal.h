// terminal.h — What a file descriptor leads to.
#pragma once

#include <cstddef>

namespace scene_analyzer::cli {

bool is_terminal(int descriptor);

// A terminal that shows colours: not with NO_COLOR (https://no-color.org) or TERM=dumb.
bool wants_color(int descriptor);

// Columns; 0 when it is no terminal or does not say.
std::size_t terminal_width(int descriptor);

}  // namespace scene_analyzer::cli
