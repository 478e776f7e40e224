#include "defects/far_from_origin.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scene_analyzer::defects {
namespace {

bool is_far(float low, float high) {
  return is_far_from_origin({low, 0, 0}, {high, 0, 0});
}

// Between 8192 and 16384 float32 has steps of 2^-10.
TEST(FarFromOrigin, BeginsBelow1024StepsOfTheLargestSide) {
  EXPECT_FALSE(is_far(8192, 8193));
  EXPECT_TRUE(is_far(8192, std::nextafter(8193.0F, 0.0F)));
  EXPECT_TRUE(is_far(16383, 16384)) << "the next binade";
  EXPECT_TRUE(is_far(-8192.5F, -8192));
  EXPECT_FALSE(is_far(-8193, -8192));
  EXPECT_FALSE(is_far_from_origin({8192, 0, 0}, {8192, 0, 1})) << "any side";
  EXPECT_FALSE(is_far(131061, 131071)) << "metrics.md's example";
  EXPECT_TRUE(is_far(131062, 131072));
}

TEST(FarFromOrigin, ScaleDoesNotMatter) {
  for (const float scale : {1e-40F, 1e-30F, 1.0F, 1e30F}) {
    EXPECT_FALSE(is_far(-scale, scale));
    EXPECT_FALSE(is_far(0, scale));
    EXPECT_TRUE(is_far(scale, scale)) << "a point has no steps at all";
  }
  EXPECT_FALSE(is_far(0, 0));
}

}  // namespace
}  // namespace scene_analyzer::defects
