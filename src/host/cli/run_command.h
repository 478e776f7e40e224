// run_command.h — Errors as exit codes, once for every program.
#pragma once

#include <functional>

namespace scene_analyzer::cli {

// Runs it with the log set up, until it knows better. What it throws is logged, with the remedy, and becomes
// the exit code.
int run_command(const std::function<int()>& command);

}  // namespace scene_analyzer::cli
