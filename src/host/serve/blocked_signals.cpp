#include "serve/blocked_signals.h"

#include <cerrno>
#include <system_error>

namespace scene_analyzer::serve {

BlockedSignals::BlockedSignals(std::initializer_list<int> signals) {
  sigemptyset(&signals_);
  for (const int signal : signals) sigaddset(&signals_, signal);
  const int error = pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  if (error != 0) throw std::system_error(error, std::generic_category(), "blocking signals");
}

BlockedSignals::~BlockedSignals() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

int BlockedSignals::wait() const {
  while (true) {
    const int signal = sigwaitinfo(&signals_, nullptr);
    if (signal >= 0) return signal;
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for signals");
  }
}

std::optional<int> BlockedSignals::wait_for(std::chrono::milliseconds time) const {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
  const timespec limit{static_cast<time_t>(seconds.count()),
                       static_cast<long>(std::chrono::nanoseconds(time - seconds).count())};
  const int signal = sigtimedwait(&signals_, nullptr, &limit);
  if (signal >= 0) return signal;
  if (errno != EAGAIN && errno != EINTR)
    throw std::system_error(errno, std::generic_category(), "waiting for signals");
  return std::nullopt;
}

}  // namespace scene_analyzer::serve
