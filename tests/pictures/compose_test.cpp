// View and legend as a PNG file, pixel by pixel.
#include "pictures/compose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rated_scene.h"
#include "support/png.h"

namespace scene_analyzer::pictures {
namespace {

using test::decode_png;
using test::Png;

scene_render::Picture colorful(std::uint32_t width, std::uint32_t height) {
  scene_render::Picture picture{width, height, {}};
  for (std::uint32_t i = 0; i < width * height; ++i)
    picture.rgba.insert(picture.rgba.end(), {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 7),
                                             static_cast<std::uint8_t>(i / 31), 255});
  return picture;
}

Legend sample_legend(const std::string& scene = "room.glb") {
  return make_legend({.subject = Subject::kAggregate}, test::rated({0.25, 1.0, std::nullopt}), scene);
}

Png composed(std::uint32_t width, std::uint32_t height, const Legend& legend,
             std::span<const Mark> marks = {}) {
  const auto view = colorful(width, height - legend_height(width, height));
  return decode_png(compose(view, marks, legend, height));
}

TEST(Compose, TheViewIsThereAsItWasDrawn) {
  const std::uint32_t width = 300, height = 200;
  const Png png = composed(width, height, sample_legend());
  ASSERT_EQ(png.width, 300);
  ASSERT_EQ(png.height, 200);
  const auto rows = static_cast<int>(height - legend_height(width, height));
  ASSERT_GT(rows, 100);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < 300; ++x) {
      const int i = y * 300 + x;
      ASSERT_EQ(png.at(x, y), (std::array{i & 255, i / 7 & 255, i / 31 & 255})) << x << ", " << y;
    }
}

TEST(Compose, WhoeverLooksMayEndIt) {
  struct Enough {};
  const auto view = colorful(300, 200 - legend_height(300, 200));
  int looks = 0;
  const auto look = [&] {
    if (++looks == 3) throw Enough();
  };
  EXPECT_THROW(compose(view, {}, sample_legend(), 200, look), Enough);
  EXPECT_EQ(looks, 3) << "it went on";
  const std::string alone = compose(view, {}, sample_legend(), 200);
  EXPECT_TRUE(alone == compose(view, {}, sample_legend(), 200, [] {}));
}

// Whether the row has all the colours of the bar from left to right, and where it begins and ends.
void expect_bar(const Png& png, int y, const Legend& legend) {
  int begin = 0, end = png.width;
  const auto is_paper = [&](int x) { return png.at(x, y)[0] > 240 && png.at(x, y)[2] > 240; };
  while (begin < png.width && is_paper(begin)) ++begin;
  while (end > begin && is_paper(end - 1)) --end;
  ASSERT_GT(end - begin, png.width / 4);
  for (int x = begin + 2; x < end - 2; ++x) {
    const ratings::Rgb expected = legend.bar((x + 0.5 - begin) / (end - begin));
    for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(png.at(x, y)[i], 255 * expected[i], 5) << x;
  }
}

TEST(Compose, TheBarHasTheColorsOfTheMap) {
  for (const ratings::ColorMap map : {ratings::ColorMap::kThesis, ratings::ColorMap::kCividis}) {
    // Without missing values, and with a text that ends before the bar: the row has nothing else.
    Legend legend = make_legend({.subject = Subject::kAggregate, .map = map}, test::rated({0.25, 1.0}), "");
    legend.lines.clear();
    legend.title.clear();
    const Png png = composed(1280, 720, legend);
    expect_bar(png, 720 - 76 + 32, legend);
    const Png small = composed(640, 360, legend);
    expect_bar(small, 360 - 38 + 16, legend);
  }
}

TEST(Compose, WordsAndRingsAreVisible) {
  const auto dark = [](const Png& png, int left, int right, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x)
        count += png.at(x, y)[0] + png.at(x, y)[1] + png.at(x, y)[2] < 300 ? 1 : 0;
    return count;
  };
  const Png png = composed(1280, 720, sample_legend());
  EXPECT_GT(dark(png, 20, 400, 650, 680), 200) << "the title";
  const scene_render::Picture white{1280, 644, std::vector<std::uint8_t>(std::size_t{4} * 1280 * 644, 255)};
  const std::vector<Mark> marks = {{.x = 100, .y = 80, .name = ""}};
  const Png ringed = decode_png(compose(white, marks, {}, 720));
  const int radius = static_cast<int>(mark_radius(1280, 720));
  EXPECT_GT(dark(ringed, 100 - radius - 2, 100 + radius + 2, 80 - radius - 2, 80 + radius + 2), 3 * radius);
  EXPECT_EQ(dark(ringed, 100 - radius / 2, 100 + radius / 2, 80 - radius / 2, 80 + radius / 2), 0);
  EXPECT_EQ(dark(ringed, 200, 1280, 0, 644), 0);
}

TEST(Compose, AnyNameAndAnySizeIsGood) {
  const std::string hostile = "bad\xff\xfe \x1b[31m\n" + std::string(5000, 'x');
  for (const auto& [width, height] : {std::pair{64U, 64U}, {2000U, 64U}, {64U, 2000U}, {700U, 500U}}) {
    const std::vector<Mark> marks = {{.x = 5, .y = 5, .name = hostile},
                                     {.x = 1e9, .y = -1e9, .name = hostile}};
    const Png png = composed(width, height, sample_legend(hostile), marks);
    EXPECT_EQ(png.width, static_cast<int>(width));
    EXPECT_EQ(png.height, static_cast<int>(height));
  }
}

TEST(Compose, TheSameTwice) {
  const scene_render::Picture view = colorful(100, 100);
  EXPECT_EQ(compose(view, {}, sample_legend(), 150), compose(view, {}, sample_legend(), 150));
}

}  // namespace
}  // namespace scene_analyzer::pictures
