#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "report/fixture.h"
#include "report/gap_text.h"
#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

TEST(Table, ShowsFourDecimalsAndDashes) {
  Fixture fixture = two_assets();
  fixture.assets.pop_back();
  const auto lines = lines_of(table(fixture.report(), {}));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_THAT(words_of(lines[0]), ::testing::ElementsAre("name", "triangles", "groups", "R_pppg", "R_pgv",
                                                         "R_rd", "R_d", "R_ccm", "R_ft", "R_rt", "R"));
  EXPECT_THAT(words_of(lines[1]),
              ::testing::ElementsAre("leg", "left", "40", "12", "0.7179", "0.3873", "0.5000", ::testing::_,
                                     "0.3333", "0.0917", "0.5000", ::testing::_));
  EXPECT_THAT(words_of(lines[2])[6], "-0.5000");
  EXPECT_THAT(words_of(lines[3]),
              ::testing::ElementsAre("helper", "0", "-", "-", "-", "-", "-", "-", "-", "-", "-"));
  EXPECT_EQ(lines[5], "3 meshes, 80 triangles (40 unique), 2 degenerate left out");
  EXPECT_EQ(lines[6], "R_rt was measured on llvmpipe (LLVM 15), a CPU device: it says nothing about a GPU");
}

TEST(Table, AlignsEveryRowWhateverTheNames) {
  Fixture fixture = two_assets();
  fixture.assets[0].instances[0].node = "T\u00fcrgriff \u6f22\u5b57 e\u0301";
  const UnicodeScope unicode;
  const auto lines = lines_of(table(fixture.report(), {}));
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(columns(printable(lines[i])), columns(printable(lines[0]))) << lines[i];
}

TEST(Table, LetsNoNameControlTheTerminal) {
  Fixture fixture = two_assets();
  fixture.assets[1].asset = "evil\x1b]0;title\x07.obj";
  for (auto& asset : fixture.assets) asset.timings[0].conditions.device.name = "GPU\x1b[0m";
  const std::string text = table(fixture.report(), {});
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\x07'), std::string::npos);
  EXPECT_EQ(lines_of(text).size(),
            9u);  // head, five meshes, rule, totals, R_rt: the name's line break made none
}

TEST(Table, PrefixesMeshesOnlyWhenThereAreSeveralAssets) {
  Fixture fixture = two_assets();
  EXPECT_THAT(table(fixture.report(), {}), HasSubstr("room.glb: leg left"));
  fixture.assets[1].asset = "other/room.glb";
  EXPECT_THAT(table(fixture.report(), {}), HasSubstr("models/room.glb: leg left"));
  EXPECT_THAT(table(fixture.report(), {}), HasSubstr("other/room.glb: huge"));
  fixture.assets.pop_back();
  EXPECT_THAT(table(fixture.report(), {}), Not(HasSubstr("room.glb")));
}

TEST(Table, FallsBackToTheMeshName) {
  Fixture fixture = two_assets();
  fixture.assets[0].instances[0].node.clear();
  fixture.assets[0].instances[1].node.clear();
  fixture.assets[0].instances[1].mesh.clear();
  const std::string text = table(fixture.report(), {});
  EXPECT_THAT(text, HasSubstr("room.glb: leg "));
  EXPECT_THAT(text, HasSubstr("room.glb: (unnamed) "));
}

TEST(Table, ColorsCellsReadably) {
  Fixture fixture = two_assets();
  fixture.options.metrics.reset().set(analysis::index_of(analysis::Metric::kRelativeDensity));
  fixture.options.relative = true;
  const std::string text = table(fixture.report(), {.color = true});
  EXPECT_THAT(text, HasSubstr("\x1b[48;2;255;0;0m\x1b[38;2;255;255;255m 1.0000\x1b[0m"));  // white on red
  EXPECT_THAT(text, HasSubstr("\x1b[48;2;0;0;255m\x1b[38;2;255;255;255m-1.0000\x1b[0m"));  // white on blue
  fixture.options = {};
  for (auto& geometry : fixture.assets[0].geometries) geometry.cooccurrence_contrast = 0.5;
  EXPECT_THAT(table(fixture.report(), {.color = true}),
              HasSubstr("\x1b[48;2;255;255;0m\x1b[38;2;0;0;0m 0.5000\x1b[0m"));  // black on yellow
  EXPECT_THAT(table(fixture.report(), {}), Not(HasSubstr("\x1b")));
}

TEST(Table, FitsTheTerminal) {
  Fixture fixture = two_assets();
  fixture.assets[0].instances[0].node = std::string(500, 'x') + "end";
  const UnicodeScope unicode;
  for (const std::size_t width : {100u, 120u, 140u})
    for (const std::string& line : lines_of(table(fixture.report(), {.width = width})))
      EXPECT_LE(columns(printable(line)), width) << line;
  EXPECT_THAT(table(fixture.report(), {.width = 120}), HasSubstr("xend "));
  EXPECT_LT(lines_of(table(fixture.report(), {}))[0].size(), 200u);  // one name does not widen every row
}

TEST(Table, MarksFourierRatingsThatAreNotFinal) {
  Fixture fixture = two_assets();
  EXPECT_THAT(table(fixture.report(), {}), Not(HasSubstr("~"))) << "a gap of 0 is proven";
  fixture.assets[0].geometries[0].signal->gap = 0.0131;
  const auto lines = lines_of(table(fixture.report(), {}));
  EXPECT_THAT(words_of(lines[1]), ::testing::Contains("~0.0917"));
  EXPECT_THAT(words_of(lines[5]), ::testing::Contains("0.0917")) << "the other asset's leg is proven";
  ASSERT_EQ(lines.size(), 12u);
  EXPECT_THAT(lines[8], ::testing::StartsWith("~ R_ft is not final for 2 meshes"));
  EXPECT_THAT(lines[9], HasSubstr("up to 1.4 % farther"));
  EXPECT_THAT(lines[10], HasSubstr("--start-searches"));
  const UnicodeScope unicode;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(columns(printable(lines[i])), columns(printable(lines[0])));
  for (const std::string& line : lines_of(table(fixture.report(), {.width = 100})))
    EXPECT_LE(columns(printable(line)), 100u);
  EXPECT_THAT(table(fixture.report(), {.color = true}), HasSubstr("m~0.0917\x1b[0m"));
}

TEST(Table, DoesNotMarkARatingThatIsNotShown) {
  Fixture fixture = two_assets();
  fixture.assets[0].geometries[0].signal->gap = 0.5;
  fixture.options.metrics.reset(index_of(analysis::Metric::kFourierTransform));
  EXPECT_THAT(table(fixture.report(), {}), Not(HasSubstr("~")));
}

TEST(Table, CountsMeshesWithoutAFourierRating) {
  Fixture fixture = two_assets();
  fixture.assets[0].geometries[0].fourier_transform.reset();
  fixture.assets[0].geometries[0].signal.reset();
  fixture.assets[0].geometries[0].no_fourier_transform = "a signal is too long";
  EXPECT_THAT(table(fixture.report(), {}), HasSubstr(", 2 meshes without a Fourier rating"));
}

TEST(Table, SaysWhatRenderingTimesMean) {
  Fixture fixture = two_assets();
  for (auto& asset : fixture.assets) asset.timings[0].conditions.device.type = "discrete";
  fixture.assets[1].timings[0].times[1] = {};
  fixture.assets[1].timings[0].times[1].not_measured = "too large";
  EXPECT_THAT(table(fixture.report(), {}),
              HasSubstr("\nR_rt was measured on llvmpipe (LLVM 15); 1 mesh not measured\n"));
  fixture.options.metrics.reset(index_of(analysis::Metric::kRenderingTime));
  EXPECT_THAT(table(fixture.report(), {}), Not(HasSubstr("measured on")));
}

TEST(GapPercent, IsABoundOfTwoDigits) {
  EXPECT_EQ(gap_percent(0.0131), "1.4 %");
  EXPECT_EQ(gap_percent(0.013), "1.3 %");
  EXPECT_EQ(gap_percent(0.07), "7.0 %");
  EXPECT_EQ(gap_percent(0.1201), "13 %");
  EXPECT_EQ(gap_percent(0.00051), "0.051 %");
  EXPECT_EQ(gap_percent(1e-300), "0.010 %");
  EXPECT_EQ(gap_percent(0.0999), "10.0 %");
  EXPECT_EQ(gap_percent(1.234), "130 %");
}

TEST(Table, TellsHowManyRowsItLeftOut) {
  const Fixture fixture = many_instances(12);
  EXPECT_THAT(table(fixture.report(), {.max_rows = 5}), HasSubstr("... and 7 more meshes ("));
  EXPECT_THAT(table(fixture.report(), {.max_rows = 11}), HasSubstr("... and 1 more mesh ("));
  EXPECT_THAT(table(fixture.report(), {.max_rows = 12}), Not(HasSubstr("... and")));
  EXPECT_THAT(table(fixture.report(), {.max_rows = 5}), HasSubstr("12 meshes, 480 triangles (40 unique)"));
}

TEST(Table, ShowsRelativeRatingsInRelativeMode) {
  Fixture fixture = two_assets();
  fixture.assets[1].geometries[1].cooccurrence_contrast = 0.4;
  fixture.options.relative = true;
  const auto lines = lines_of(table(fixture.report(), {}));
  EXPECT_THAT(lines[7], HasSubstr("relative to this scene"));
  EXPECT_THAT(lines[7], HasSubstr("1 mesh not analysed"));
  EXPECT_THAT(lines[5], HasSubstr("1.0000"));
}

TEST(Table, OfNothingHasAHeadAndTotals) {
  const Fixture nothing;
  EXPECT_EQ(lines_of(table(nothing.report(), {})).back(), "0 meshes, 0 triangles");
}

}  // namespace
}  // namespace scene_analyzer::report
