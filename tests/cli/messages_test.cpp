// What reaches the terminal: log lines and progress.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <thread>

#include "base/error.h"
#include "cli/logging.h"
#include "cli/progress.h"

namespace scene_analyzer::cli {
namespace {

TEST(OneLine, TextOfFilesCannotDriveTheTerminal) {
  EXPECT_EQ(one_line("plain.obj: fine"), "plain.obj: fine");
  EXPECT_EQ(one_line("two\nlines\n"), "two lines");
  EXPECT_EQ(one_line("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(one_line("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(one_line("a\rb\x7f"), "a\\x0db\\x7f");
  EXPECT_EQ(one_line("c1 \xc2\x9b[0m"), "c1 \\xc2\\x9b[0m");
  EXPECT_EQ(one_line(""), "");
}

TEST(LogLevel, QuietAndVerboseExcludeEachOther) {
  EXPECT_EQ(log_level(true, false), LogLevel::kQuiet);
  EXPECT_EQ(log_level(false, true), LogLevel::kVerbose);
  EXPECT_EQ(log_level(false, false), LogLevel::kNormal);
  EXPECT_THROW(log_level(true, true), UsageError);
}

TEST(ProgressText, SharesOfAllAssets) {
  const ProgressState state{.asset = 1, .assets = 4, .done = 1.5, .name = "room.glb", .step = "areas"};
  EXPECT_EQ(progress_line(state), "progress: 37%, asset 2 of 4, room.glb: areas");
  EXPECT_EQ(progress_bar(state, 0), " 37% [#########               ] 2/4 room.glb: areas");
  EXPECT_EQ(progress_bar({.asset = 0, .assets = 1, .done = 7, .name = "a", .step = "b"}, 0),
            "100% [########################] 1/1 a: b");
}

TEST(ProgressText, FitsTheTerminalWithoutCuttingCharacters) {
  const ProgressState state{
      .asset = 0, .assets = 1, .done = 0, .name = "\xc3\xa9\xc3\xa9\xc3\xa9", .step = ""};
  const std::string whole = progress_bar(state, 0);
  for (std::size_t width = 1; width <= whole.size() + 2; ++width) {
    const std::string cut = progress_bar(state, width);
    EXPECT_LE(cut.size(), width);
    EXPECT_EQ(whole.substr(0, cut.size()), cut);
    // A character of two bytes is there whole or not at all: past the plain prefix, the length is even.
    const std::size_t prefix = whole.find('\xc3');
    if (cut.size() > prefix && cut.size() < prefix + 6) {
      EXPECT_EQ((cut.size() - prefix) % 2, 0U) << width;
    }
  }
}

// Standard error of `body`.
template <typename Body>
std::string captured(const Body& body) {
  testing::internal::CaptureStderr();
  body();
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, ShortRunsAreSilent) {
  EXPECT_EQ(captured([] {
              Progress progress(true, 1);
              progress.start_asset(0, "room.glb");
              progress.update(0, 0.5, "areas");
            }),
            "");
}

TEST(Progress, LongRunsSayWhatTheyDoUnlessQuiet) {
  const auto run = [](bool enabled) {
    return captured([&] {
      Progress progress(enabled, 2, std::chrono::milliseconds(10));
      progress.start_asset(0, "hall.glb");
      progress.update(0, 0.3, "start triangles");
      progress.start_asset(1, "room.glb");
      progress.update(1, 0.6, "areas");
      progress.finish_asset(0);
      progress.update(0, 0.5, "late");
      progress.update(1, 0.4, "areas");
      std::this_thread::sleep_for(std::chrono::seconds(1));
    });
  };
  EXPECT_EQ(run(true), "progress: 80%, asset 2 of 2, room.glb: areas\n");
  EXPECT_EQ(run(false), "");
}

}  // namespace
}  // namespace scene_analyzer::cli
