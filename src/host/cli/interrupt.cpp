#include "cli/interrupt.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <thread>

#include "cli/logging.h"
#include "cli/run_state.h"
#include "files/replace.h"

namespace scene_analyzer::cli {
namespace {

// Until the program has to end; the system needs time, too, to take back gigabytes.
constexpr std::chrono::milliseconds kGrace(400);
constexpr std::chrono::milliseconds kLongestMessage(100);

std::atomic<int> received_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // a handler may use it
std::atomic<bool> said = false, was_said = false;      // by whom it is said; whether it is out
int wake_descriptor = -1;

// Never destroyed: the watching thread may outlive main().
std::stop_source& stop_source() {
  static auto* const source = new std::stop_source;
  return *source;
}

void set_handler(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // interrupted system calls go on
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void note_signal(int signal) {
  const int error = errno;
  received_signal = signal;
  set_handler(SIG_DFL);  // one chance to stop in order
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t ignored = ::write(wake_descriptor, &one, sizeof one);
  errno = error;
}

void end_in_time() {
  std::uint64_t count = 0;
  while (::read(wake_descriptor, &count, sizeof count) < 0 && errno == EINTR) {
  }
  stop_source().request_stop();
  std::this_thread::sleep_for(kGrace);
  files::forbid_and_remove_temporaries();
  // Whoever is to read the message may not; whoever waits for that holds the log.
  std::thread(say_stopped).detach();
  const auto end = std::chrono::steady_clock::now() + kLongestMessage;
  while (!was_said && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::_Exit(128 + received_signal);
}

}  // namespace

void watch_interrupts() {
  wake_descriptor = ::eventfd(0, EFD_CLOEXEC);
  if (wake_descriptor < 0) throw std::system_error(errno, std::generic_category(), "watching for signals");
  stop_source();
  set_handler(note_signal);
  std::thread(end_in_time).detach();
}

void check_interrupt() {
  if (received_signal != 0) throw Interrupted(received_signal);
}

std::stop_token interrupt_token() {
  return stop_source().get_token();
}

void say_stopped() {
  if (said.exchange(true)) return;
  const std::string state = describe_run_state();
  log_warning(state.empty() ? "stopped" : "stopped " + state);
  was_said = true;
}

}  // namespace scene_analyzer::cli
