// What a run over a library says of itself while it goes on.
#include "cli/library_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scene_analyzer::cli {
namespace {

using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(RecentRate, IsThatOfTheLastSeconds) {
  const RecentRate::Time begin{};
  RecentRate rate(begin);
  EXPECT_EQ(rate.per_second(begin, 0), 0);
  EXPECT_EQ(rate.per_second(begin + seconds(2), 1000), 500);
  // 1000 were unchanged; from then on one is measured per second.
  double latest = 0;
  for (unsigned i = 1; i <= 60; ++i) latest = rate.per_second(begin + seconds(2 + i), 1000 + i);
  EXPECT_NEAR(latest, 1, 1e-9);
}

TEST(RecentRate, FallsToNothingWhereNothingComes) {
  const RecentRate::Time begin{};
  RecentRate rate(begin);
  for (unsigned i = 0; i < 60; ++i) rate.per_second(begin + seconds(i), 5);
  EXPECT_EQ(rate.per_second(begin + seconds(60), 5), 0);
}

TEST(LibraryProgress, SaysHowFastAndHowLong) {
  const LibraryState state{.assets = 2000, .done = 840, .failed = 3, .per_second = 21.8, .name = "chair.glb"};
  EXPECT_EQ(library_line(state), "progress: 42%, 840 of 2000 assets, 1308/min, 53 s left, 3 not analysed");
  EXPECT_THAT(library_bar(state, 0), AllOf(HasSubstr(" 42% [##########   "), HasSubstr("1308/min, 53 s left"),
                                           HasSubstr("3 not analysed: chair.glb")));
  EXPECT_EQ(library_bar(state, 40).size(), 40U);
}

TEST(LibraryProgress, SaysNothingThatIsNotKnown) {
  EXPECT_EQ(library_line({.assets = 10, .done = 0}), "progress: 0%, 0 of 10 assets");
  EXPECT_THAT(library_bar({.assets = 0}, 0), AllOf(HasSubstr("100%"), Not(HasSubstr("left"))));
}

TEST(LibraryProgress, NamesCannotMoveTheCursor) {
  EXPECT_THAT(library_bar({.assets = 2, .done = 1, .name = "a\n\x1b[2Jb"}, 0),
              AllOf(Not(HasSubstr("\n")), Not(HasSubstr("\x1b"))));
}

TEST(DurationText, ChoosesItsUnit) {
  EXPECT_EQ(duration_text(53), "53 s");
  EXPECT_EQ(duration_text(240), "4 min");
  EXPECT_EQ(duration_text(27000), "7.5 h");
}

}  // namespace
}  // namespace scene_analyzer::cli
