// devices_command.h — `scene-analyzer devices`: what can compute here, and whether it computes right.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

// Returns the exit code. Throws UsageError; gpu::Error when there is no device at all.
int devices_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
