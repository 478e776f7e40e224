#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

std::string hex(double rating, ColorMap map = ColorMap::kThesis, bool signed_range = false) {
  return to_hex(color(rating, map, signed_range));
}

// `published` in [0,1] per channel; the tables promise 2/255.
void expect_close(const Rgb& actual, const Rgb& published) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], published[i], 2.5 / 255) << "channel " << i;
}

TEST(ThesisColors, AtTheirStops) {
  EXPECT_EQ(hex(0), "#00ff00");
  EXPECT_EQ(hex(0.5), "#ffff00");
  EXPECT_EQ(hex(1), "#ff0000");
  EXPECT_EQ(hex(-0.5), "#00ffff");
  EXPECT_EQ(hex(-1), "#0000ff");
}

TEST(ThesisColors, AreLinearBetween) {
  EXPECT_EQ(color(0.25), (Rgb{0.5, 1, 0}));
  EXPECT_EQ(color(0.75), (Rgb{1, 0.5, 0}));
  EXPECT_EQ(color(-0.25), (Rgb{0, 1, 0.5}));
  EXPECT_EQ(color(-0.75), (Rgb{0, 0.5, 1}));
}

TEST(ThesisColors, HaveNoSeams) {
  for (const double at : {-0.5, 0.0, 0.5}) {
    const Rgb below = color(at - 1e-9), above = color(at + 1e-9);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(below[i], above[i], 1e-8) << at;
  }
}

TEST(Colors, ClampRatingsBeyondTheRange) {
  for (const ColorMap map : {ColorMap::kThesis, ColorMap::kViridis, ColorMap::kCividis, ColorMap::kCoolwarm})
    for (const bool is_signed : {false, true}) {
      EXPECT_EQ(hex(1.5, map, is_signed), hex(1, map, is_signed));
      EXPECT_EQ(hex(-7, map, is_signed), hex(-1, map, is_signed));
    }
}

TEST(Colors, StayInTheUnitCube) {
  for (const ColorMap map : {ColorMap::kThesis, ColorMap::kViridis, ColorMap::kCividis, ColorMap::kCoolwarm})
    for (int i = -1000; i <= 1000; ++i)
      for (const double channel : color(i / 1000.0, map, true)) {
        EXPECT_GE(channel, 0);
        EXPECT_LE(channel, 1);
      }
}

TEST(Viridis, FollowsThePublishedTable) {
  EXPECT_EQ(hex(0, ColorMap::kViridis), "#440154");
  EXPECT_EQ(hex(1, ColorMap::kViridis), "#fde725");
  expect_close(color(10 / 255.0, ColorMap::kViridis), {0.278791, 0.062145, 0.386592});
  expect_close(color(64 / 255.0, ColorMap::kViridis), {0.229739, 0.322361, 0.545706});
  expect_close(color(128 / 255.0, ColorMap::kViridis), {0.127568, 0.566949, 0.550556});
  expect_close(color(192 / 255.0, ColorMap::kViridis), {0.369214, 0.788888, 0.382914});
}

TEST(Cividis, FollowsThePublishedTable) {
  EXPECT_EQ(hex(0, ColorMap::kCividis), "#00224e");
  EXPECT_EQ(hex(1, ColorMap::kCividis), "#fee838");
  expect_close(color(10 / 255.0, ColorMap::kCividis), {0.0, 0.163058, 0.371608});
  expect_close(color(64 / 255.0, ColorMap::kCividis), {0.263738, 0.307831, 0.422789});
  expect_close(color(128 / 255.0, ColorMap::kCividis), {0.488697, 0.485318, 0.471008});
  expect_close(color(210 / 255.0, ColorMap::kCividis), {0.811054, 0.740801, 0.385198});
}

TEST(Coolwarm, IsCentredAtZero) {
  EXPECT_EQ(hex(-1, ColorMap::kCoolwarm), "#3b4cc0");
  EXPECT_EQ(hex(0, ColorMap::kCoolwarm), "#dddddd");
  EXPECT_EQ(hex(1, ColorMap::kCoolwarm), "#b40426");
  EXPECT_EQ(hex(0.3, ColorMap::kCoolwarm, true), hex(0.3, ColorMap::kCoolwarm, false));
  expect_close(color(-11 / 16.0, ColorMap::kCoolwarm), {108 / 255.0, 142 / 255.0, 241 / 255.0});
  expect_close(color(1 / 16.0, ColorMap::kCoolwarm), {229 / 255.0, 216 / 255.0, 209 / 255.0});
  expect_close(color(11 / 16.0, ColorMap::kCoolwarm), {229 / 255.0, 112 / 255.0, 88 / 255.0});
}

TEST(SequentialMaps, SpreadOverTheSignedRangeForDensityAlone) {
  for (const ColorMap map : {ColorMap::kViridis, ColorMap::kCividis}) {
    EXPECT_EQ(hex(-1, map, true), hex(0, map));
    EXPECT_EQ(hex(0, map, true), hex(0.5, map));
    EXPECT_EQ(hex(1, map, true), hex(1, map));
    EXPECT_EQ(hex(-0.4, map), hex(0, map));  // no negative values there
  }
}

TEST(Mix, IsTheMeanWithTheLuminance) {
  EXPECT_EQ(to_hex(mix_with_luminance({0, 1, 0}, {0, 0, 0})), "#008000");
  const Rgb on_white = mix_with_luminance({0, 1, 0}, {1, 1, 1});
  EXPECT_NEAR(on_white[0], 0.5, 1e-12);
  EXPECT_NEAR(on_white[1], 1, 1e-12);
  const Rgb mixed = mix_with_luminance({1, 0.5, 0}, {0.2, 0.4, 0.8});
  const double luminance = 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.8;
  EXPECT_DOUBLE_EQ(mixed[0], (1 + luminance) / 2);
  EXPECT_DOUBLE_EQ(mixed[1], (0.5 + luminance) / 2);
  EXPECT_DOUBLE_EQ(mixed[2], luminance / 2);
}

TEST(Hex, RoundsAndNeverOverflows) {
  EXPECT_EQ(to_hex({0.5, 1.0 / 255, 254.5 / 255}), "#8001ff");
  EXPECT_EQ(to_hex({-1, 2, std::numeric_limits<double>::quiet_NaN()}), "#00ff00");
}

}  // namespace
}  // namespace scene_analyzer::ratings
