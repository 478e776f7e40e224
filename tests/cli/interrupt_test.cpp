#include "cli/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace scene_analyzer::cli {
namespace {

TEST(Interrupt, TheFirstSignalIsOnlyNoted) {
  EXPECT_NO_THROW(check_interrupt());
  watch_interrupts();
  EXPECT_NO_THROW(check_interrupt());
  raise(SIGTERM);  // would end this process without the handler
  try {
    check_interrupt();
    ADD_FAILURE() << "the signal went unnoticed";
  } catch (const Interrupted& stop) {
    EXPECT_EQ(stop.exit_code(), 143);
  }
  // The second one is for programs that do not come back.
  struct sigaction now {};
  sigaction(SIGTERM, nullptr, &now);
  EXPECT_EQ(now.sa_handler, SIG_DFL);
}

}  // namespace
}  // namespace scene_analyzer::cli
