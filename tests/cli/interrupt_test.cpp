#include "cli/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/child_process.h"

namespace scene_analyzer::cli {
namespace {

// In a process of its own, which a thread would end soon after the signal.
TEST(Interrupt, TheFirstSignalIsOnlyNoted) {
  const int status = in_child([] {
    check_interrupt();
    watch_interrupts();
    check_interrupt();
    if (interrupt_token().stop_requested()) return 1;
    raise(SIGTERM);  // would end this process without the handler
    try {
      check_interrupt();
      return 2;  // it went unnoticed
    } catch (const Interrupted& stop) {
      if (stop.exit_code() != 143) return 3;
    }
    // The second one is for programs that do not come back, whichever it is.
    for (const int signal : {SIGINT, SIGTERM}) {
      struct sigaction now {};
      sigaction(signal, nullptr, &now);
      if (now.sa_handler != SIG_DFL) return 4;
    }
    return 0;
  });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Interrupt, AProgramThatDoesNotStopIsEnded) {
  const int status = in_child([] {
    watch_interrupts();
    const auto begin = std::chrono::steady_clock::now();
    raise(SIGINT);
    while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(10))
      if (!interrupt_token().stop_requested()) std::this_thread::yield();
    return 0;
  });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
}

}  // namespace
}  // namespace scene_analyzer::cli
