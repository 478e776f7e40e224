// interrupt.h — Ctrl-C and termination signals: the program stops between two steps, so that nothing is left
// half done, and is ended within a second where a step takes longer.
#pragma once

#include <exception>
#include <stop_token>

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

// From now on the first SIGINT or SIGTERM is only noted; a second one ends the program at once. A program
// that has not ended 0.4 s after the first is ended by a thread of its own, whatever it waits for: a long
// step, a device that hangs. Files that are being written then are not there afterwards. Once per process.
void watch_interrupts();

// Throws Interrupted when a signal has come.
void check_interrupt();

// Asked to stop when a signal has come; for what waits without looking.
std::stop_token interrupt_token();

// The message about a run that a signal has ended; only the first call writes it.
void say_stopped();

}  // namespace scene_analyzer::cli
