// error.h — The two errors that users cause. Everything else is a std::exception and a defect or a failed
// machine.
//
// Thrown where the problem is found and caught only at a face (command line, batch row, service), which
// turns it into its own language once. GPU errors are in gpu/error.h.
#pragma once

#include <stdexcept>

namespace scene_analyzer {

// An asset or a file is wrong: the message names the file, the place and, where one exists, the remedy.
// Other assets of the same command go on; the command ends with exit code 3.
class InputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The request is wrong (an unknown option value, an impossible combination): exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace scene_analyzer
