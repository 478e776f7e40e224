// logging.h — Messages for people, on standard error: "warning: room.glb: ..."; one line each.
//
// Messages may hold text from hostile files: control characters are shown as \xNN and line breaks become
// spaces, so that a file cannot write to the terminal.
#pragma once

#include <spdlog/spdlog.h>

#include <string>
#include <string_view>

namespace scene_analyzer::cli {

enum class LogLevel { kQuiet, kNormal, kVerbose };  // errors; and warnings, notes; and details

// Throws UsageError when both are asked for.
LogLevel log_level(bool quiet, bool verbose);

// The default logger of spdlog from now on. Colour when standard error is a terminal that wants it.
void set_up_logging(LogLevel level);

std::string one_line(std::string_view text);

inline void log_error(std::string_view text) {
  spdlog::error("{}", one_line(text));
}
inline void log_warning(std::string_view text) {
  spdlog::warn("{}", one_line(text));
}
inline void log_note(std::string_view text) {
  spdlog::info("{}", one_line(text));
}
inline void log_detail(std::string_view text) {
  spdlog::debug("{}", one_line(text));
}

}  // namespace scene_analyzer::cli
