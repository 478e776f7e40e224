// color.cpp — Ratings as colours: the thesis' map and three that stay readable with a colour vision
// deficiency.
//
// The tables hold samples of published maps, interpolated linearly in sRGB; no channel is off by more than
// 2/255 from the originals. viridis: S. van der Walt and N. Smith, 2015 (public domain). cividis: J. Nunez,
// C. Anderton, R. Renslow, "Optimizing colormaps with consideration for color vision deficiency", PLoS ONE
// 2018. coolwarm: K. Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

struct Stop {
  double at;  // along the map, in steps of the published table
  std::uint8_t red, green, blue;
};

// Stops lie where the maps bend.
constexpr Stop kViridis[] = {{0, 68, 1, 84},      {28, 72, 40, 120},   {55, 63, 72, 137},
                             {106, 40, 124, 142}, {141, 30, 157, 137}, {159, 39, 173, 129},
                             {179, 68, 191, 112}, {205, 124, 210, 80}, {238, 210, 226, 27},
                             {246, 231, 228, 25}, {255, 253, 231, 37}};
constexpr Stop kCividis[] = {{0, 0, 34, 78},       {20, 0, 48, 112},     {23, 1, 50, 113},
                             {30, 22, 55, 112},    {47, 49, 67, 109},    {97, 98, 101, 111},
                             {138, 134, 131, 121}, {186, 182, 169, 111}, {224, 222, 201, 88},
                             {247, 248, 223, 60},  {252, 254, 228, 52},  {255, 254, 232, 56}};
// Over 0..32, and with a stop in the very middle.
constexpr Stop kCoolwarm[] = {
    {0, 59, 76, 192},    {3, 87, 117, 225},   {6, 119, 154, 247},  {9, 152, 185, 255},  {12, 184, 208, 249},
    {15, 213, 219, 230}, {16, 221, 221, 221}, {19, 241, 204, 185}, {22, 247, 177, 148}, {25, 241, 141, 111},
    {28, 222, 96, 77},   {30, 203, 62, 56},   {31, 192, 40, 47},   {32, 180, 4, 38}};

// `position` in [0,1].
Rgb interpolate(std::span<const Stop> stops, double position) {
  const double at = position * stops.back().at;
  std::size_t next = 1;
  while (next + 1 < stops.size() && stops[next].at < at) ++next;
  const Stop& a = stops[next - 1];
  const Stop& b = stops[next];
  const double share = (at - a.at) / (b.at - a.at);
  const auto channel = [share](double from, double to) { return (from + (to - from) * share) / 255; };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

// Green, yellow, red above 0; green, cyan, blue below: linear between the halves.
Rgb thesis(double rating) {
  if (rating >= 0) return {std::min(1.0, 2 * rating), std::min(1.0, 2 - 2 * rating), 0};
  return {0, std::min(1.0, 2 + 2 * rating), std::min(1.0, -2 * rating)};
}

std::uint8_t to_byte(double channel) {
  // The comparison is false for NaN, which lround could not take.
  return channel > 0 ? static_cast<std::uint8_t>(std::lround(std::min(channel, 1.0) * 255)) : 0;
}

}  // namespace

Rgb color(double rating, ColorMap map, bool signed_range) {
  const double value = std::clamp(rating, -1.0, 1.0);
  const double along = signed_range ? (value + 1) / 2 : std::max(value, 0.0);
  switch (map) {
    case ColorMap::kThesis:
      return thesis(value);
    case ColorMap::kViridis:
      return interpolate(kViridis, along);
    case ColorMap::kCividis:
      return interpolate(kCividis, along);
    case ColorMap::kCoolwarm:
      return interpolate(kCoolwarm, (value + 1) / 2);
  }
  return thesis(value);  // not reached: every map has its case
}

Rgb mix_with_luminance(const Rgb& rating_color, const Rgb& original) {
  const double luminance = 0.299 * original[0] + 0.587 * original[1] + 0.114 * original[2];
  return {(rating_color[0] + luminance) / 2, (rating_color[1] + luminance) / 2,
          (rating_color[2] + luminance) / 2};
}

std::string to_hex(const Rgb& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", unsigned{to_byte(color[0])}, unsigned{to_byte(color[1])},
                unsigned{to_byte(color[2])});
  return text;
}

}  // namespace scene_analyzer::ratings
