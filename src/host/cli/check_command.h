// check_command.h — `scene-analyzer check ASSET... --budget FILE`: assets against limits, for CI.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Returns the exit code. Throws UsageError; gpu::Error when the machine fails; Interrupted.
int check_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
