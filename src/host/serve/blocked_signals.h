// blocked_signals.h — Signals that a service waits for in place of being interrupted by them.
#pragma once

#include <csignal>

#include <chrono>
#include <initializer_list>
#include <optional>

namespace scene_analyzer::serve {

class BlockedSignals {
 public:
  // Blocks them in this thread and those that it starts from now on: make it before any other.
  explicit BlockedSignals(std::initializer_list<int> signals);
  ~BlockedSignals();  // as before; pending ones are delivered then
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

  int wait() const;  // for the next
  std::optional<int> wait_for(std::chrono::milliseconds time) const;

 private:
  sigset_t signals_{}, before_{};
};

}  // namespace scene_analyzer::serve
