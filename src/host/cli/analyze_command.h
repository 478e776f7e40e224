// analyze_command.h — `scene-analyzer analyze ASSET...`: several assets, one scene, one table.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Returns the exit code. Throws UsageError before anything is written; gpu::Error when the machine fails;
// Interrupted.
int analyze_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
