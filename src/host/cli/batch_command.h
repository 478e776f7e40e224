// batch_command.h — `scene-analyzer batch`.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Returns the exit code; throws what main() turns into one.
int batch_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
