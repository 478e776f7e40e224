// How fluently a window moved.
#include "viewer/frame_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scene_analyzer::viewer {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(FrameTimes, SleepIsNoSlowPicture) {
  FrameTimes times;
  EXPECT_EQ(times.summary(), std::nullopt);
  times.shown(10, true);  // the first one followed nothing
  EXPECT_EQ(times.summary(), std::nullopt);
  times.shown(10.02, true);
  times.shown(99, false);
  times.shown(99.02, true);
  EXPECT_NEAR(times.last_milliseconds(), 20, 1e-6);
  EXPECT_THAT(*times.summary(), AllOf(StartsWith("2 pictures in motion: 50.0 per second"),
                                      HasSubstr("half of them within 20.0 ms, 95 % within 20.0 ms")));
}

TEST(FrameTimes, SlowOnesShowInThe95Percent) {
  FrameTimes times;
  double now = 0;
  times.shown(now, true);
  for (int i = 0; i < 100; ++i) times.shown(now += i % 10 == 0 ? 0.1 : 0.01, true);
  EXPECT_THAT(*times.summary(), HasSubstr("half of them within 10.0 ms, 95 % within 100.0 ms"));
}

TEST(FrameTimes, ManyPicturesForgetTheOldest) {
  FrameTimes times;
  double now = 0;
  times.shown(now, true);
  for (int i = 0; i < 100'000; ++i) times.shown(now += 1, true);
  for (int i = 0; i < 100'000; ++i) times.shown(now += 0.01, true);
  EXPECT_THAT(*times.summary(), StartsWith("200000 pictures in motion: 100.0 per second"));
}

}  // namespace
}  // namespace scene_analyzer::viewer
