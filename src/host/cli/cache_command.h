// cache_command.h — `scene-analyzer cache --prune --cache-dir DIR`: keeps a folder of analysis files small.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Returns the exit code. Throws UsageError; InputError when the folder cannot be read.
int cache_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
