#include "report/signal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "report/fixture.h"
#include "report/plot.h"

namespace scene_analyzer::report {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

// What one mesh hands over: areas with magnitudes made up, and its analysis.
struct Sample {
  std::vector<double> areas, magnitudes;
  analysis::GeometryAnalysis geometry;

  analysis::SignalSpectrum spectrum() const { return {areas, magnitudes}; }
  std::string svg(double area_scale = 1, const std::string& title = "leg") const {
    return signal_svg(spectrum(), geometry, area_scale, title);
  }
};

Sample sample(std::size_t length) {
  Sample result;
  for (std::size_t i = 0; i < length; ++i)
    result.areas.push_back(0.3 + 0.2 * std::sin(static_cast<double>(i) / 7) + (i % 2 == 0 ? 0.05 : 0));
  for (std::size_t k = 0; k <= length / 2; ++k)
    result.magnitudes.push_back(10.0 / (1 + static_cast<double>(k)));
  if (length == 0) result.magnitudes.clear();
  result.geometry.triangles = result.geometry.source_triangles = length;
  result.geometry.fourier_transform = 0.09168;
  result.geometry.signal = {
      .length = length, .start_triangle = 17, .mean_distance = 0.34125, .gap = 0, .searches = 9};
  return result;
}

// Whether an XML reader takes it.
bool is_xml(const std::string& text) {
  const TemporaryFolder folder;
  write_file(folder.path / "picture.svg", text);
  const std::string command =
      "/usr/bin/python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' '" +
      (folder.path / "picture.svg").string() + "'";
  return std::system(command.c_str()) == 0;
}

TEST(SignalCsv, NumbersItsValuesFromZero) {
  EXPECT_EQ(signal_csv(std::vector<double>{0.1, 1.0 / 3}, 1), "index,area\n0,0.1\n1,0.3333333333333333\n");
  EXPECT_EQ(spectrum_csv(std::vector<double>{300, 100.5}, 4), "k,magnitude\n0,1200\n1,402\n");
  EXPECT_EQ(signal_csv({}, 1), "index,area\n");
}

TEST(SignalSvg, SaysWhatItShows) {
  const std::string svg = sample(40).svg();
  EXPECT_THAT(svg, AllOf(HasSubstr(">leg</text>"), HasSubstr("N = 40"), HasSubstr("R_ft = 0.0917"),
                         HasSubstr("Start triangle 17"), HasSubstr("0.3412 units"), HasSubstr("proven")));
  EXPECT_THAT(svg, AllOf(HasSubstr("|X_0| = 10,"), HasSubstr("|X_k| = 5 at k = 1"),
                         HasSubstr("area, square units"), HasSubstr("|X_k|, square units"),
                         HasSubstr("place in the order"), Not(HasSubstr("per column"))));
  EXPECT_EQ(svg, sample(40).svg()) << "the same every time";
  EXPECT_TRUE(is_xml(svg));
}

TEST(SignalSvg, GivesTheGapAndWorldUnits) {
  Sample half_proven = sample(40);
  half_proven.geometry.signal->gap = 0.0131;
  const std::string svg = half_proven.svg(4);
  EXPECT_THAT(svg, AllOf(HasSubstr("R_ft = ~0.0917"), HasSubstr("Gap 1.4 %"), Not(HasSubstr("proven"))));
  EXPECT_THAT(svg, AllOf(HasSubstr("0.6825 units"), HasSubstr("|X_0| = 40,")));
}

TEST(SignalSvg, StaysSmallHoweverLongTheSignal) {
  const std::string svg = sample(1'000'000).svg(1, "<a> & \x01\xff" + std::string(500, 'x'));
  EXPECT_LT(svg.size(), 120'000u);
  EXPECT_THAT(svg, HasSubstr("per column the least to the greatest"));
  EXPECT_TRUE(is_xml(svg));
}

TEST(SignalSvg, TakesSignalsOfAllKinds) {
  EXPECT_THAT(sample(0).svg(), AllOf(HasSubstr("N = 0"), Not(HasSubstr("<path")), HasSubstr("</svg>")));
  for (const std::size_t length :
       {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{720}, std::size_t{721}})
    EXPECT_TRUE(is_xml(sample(length).svg())) << length;
  Sample odd = sample(8);
  odd.geometry.signal.reset();
  odd.geometry.fourier_transform.reset();
  EXPECT_THAT(odd.svg(), Not(HasSubstr("R_ft")));
  for (const double scale : {0.0, 1e-320, 1e308, std::numeric_limits<double>::infinity()}) {
    const std::string svg = sample(8).svg(scale);
    EXPECT_TRUE(is_xml(svg)) << scale;
    EXPECT_THAT(svg.substr(svg.find("<path")), Not(AnyOf(HasSubstr("Vnan"), HasSubstr("Vinf")))) << scale;
  }
}

TEST(SignalSvg, NoiseDoesNotFillTheDiagram) {
  Sample equal = sample(8);
  equal.areas.assign(8, 0.25);
  equal.magnitudes = {2, 3e-17, 1e-17, 2e-17, 0};
  // The path of the magnitudes never leaves the bottom by more than rounding: 420 + 196.
  const std::string svg = equal.svg();
  const std::string spectrum = svg.substr(svg.find("fill=\"#a8401f\""));
  EXPECT_THAT(spectrum, HasSubstr("V616.0H276.0V616.0H456.0V616.0"));
}

TEST(Envelope, KeepsEveryExtremeOnce) {
  std::vector<double> values(10'007, 1);
  values[0] = 3;
  values[5000] = -2;
  values[10'006] = 7;
  const auto columns = envelope(values, 720);
  ASSERT_EQ(columns.size(), 720u);
  EXPECT_EQ(columns.front().greatest, 3);
  EXPECT_EQ(columns.back().greatest, 7);
  EXPECT_EQ(columns.back().least, 1);
  std::size_t low = 0, high = 0;
  for (const Extremes& column : columns) {
    low += column.least < 1 ? 1 : 0;
    high += column.greatest > 1 ? 1 : 0;
  }
  EXPECT_EQ(low, 1u);
  EXPECT_EQ(high, 2u);
  EXPECT_EQ(envelope(std::vector<double>{5, 6}, 720).size(), 2u);
  EXPECT_TRUE(envelope({}, 720).empty());
}

}  // namespace
}  // namespace scene_analyzer::report
