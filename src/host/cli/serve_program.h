// serve_program.h — `scene-analyzer serve`, which is a program of its own: the libraries of a network service
// would make every other command start three times as slowly.
#pragma once

#include <span>
#include <string>

namespace scene_analyzer::cli {

inline constexpr const char* kServeProgram = "scene-analyzer-serve";

// Becomes that program, which lies where files/helper_program.h says. Throws UsageError when it is not there.
int serve_program(std::span<const std::string> arguments);

}  // namespace scene_analyzer::cli
