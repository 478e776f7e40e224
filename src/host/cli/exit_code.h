// exit_code.h — What the program's exit code says. Printed by every --help; scripts rely on it.
#pragma once

namespace scene_analyzer::cli {

enum ExitCode : int {
  kSuccess = 0,
  kDefect = 1,         // an unexpected error of the program itself
  kUnusable = 2,       // the request or the machine: options, no usable device, a failed self-test
  kInputFailed = 3,    // at least one asset or file could not be used; everything else was done
  kInterrupted = 130,  // SIGINT
  kTerminated = 143,   // SIGTERM
};

inline constexpr const char* kExitCodeHelp =
    "Exit codes:\n"
    "  0  done\n"
    "  1  a defect of the program\n"
    "  2  wrong options, or no usable device; nothing was written\n"
    "  3  an asset or a file could not be used (the others were)\n"
    "  130, 143  stopped by Ctrl-C or a termination signal\n";

}  // namespace scene_analyzer::cli
