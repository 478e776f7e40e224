// exit_code.h — What the program's exit code says. Printed by every --help; scripts rely on it.
#pragma once

namespace scene_analyzer::cli {

enum ExitCode : int {
  kSuccess = 0,
  kGateFailed = 1,  // the assets are not good enough, or not all there: never an error of request or program
  kUnusable =
      2,  // the request, the machine or the program: options, no usable device, a failed self-test, a defect
  kInputFailed = 3,    // at least one asset or file could not be used; everything else was done
  kInterrupted = 130,  // SIGINT
  kTerminated = 143,   // SIGTERM
};

inline constexpr const char* kExitCodeHelp =
    "Exit codes:\n"
    "  0  done\n"
    "  2  wrong options, no usable device, or an error of the program; no report was written,\n"
    "     or its pictures are missing\n"
    "  3  an asset or a file could not be used (the others were)\n"
    "  130, 143  stopped by Ctrl-C or a termination signal, within a second; no report of a part is "
    "written,\n"
    "     but analyses of assets that are done are kept, and the same command goes on from there\n";

}  // namespace scene_analyzer::cli
