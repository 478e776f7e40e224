// view_command.h — `scene-analyzer view`: the review window.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Arguments after the command's name; returns the exit code. Throws UsageError, gpu::NoDevice,
// window::NoDisplay.
int view_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
