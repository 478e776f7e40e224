// interrupt.h — Ctrl-C and termination signals: the program stops between two steps, so that nothing is left
// half done.
#pragma once

#include <exception>

namespace scene_analyzer::cli {

// Thrown by check_interrupt(); not a std::runtime_error, so that no handler of ordinary errors takes it.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  const char* what() const noexcept override { return "stopped by a signal"; }
  int exit_code() const { return 128 + signal_; }

 private:
  int signal_;
};

// From now on the first SIGINT or SIGTERM is only noted; a second one ends the program at once.
void watch_interrupts();

// Throws Interrupted when a signal has come.
void check_interrupt();

}  // namespace scene_analyzer::cli
