// serve_command.h — `scene-analyzer serve`: the service from its first to its last request.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::serve {

int serve_command(std::span<const std::string> arguments);

}  // namespace scene_analyzer::serve
