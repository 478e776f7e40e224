#include "report/histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scene_analyzer::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

analysis::Histogram two_areas() {
  analysis::Histogram histogram;
  histogram.values = {0.1, 0.3};
  histogram.pairs = {{0, 0, 6}, {0, 1, 5'000'000'000}, {1, 0, 5'000'000'000}};
  histogram.bins.assign(std::size_t{analysis::kHistogramBins} * analysis::kHistogramBins, 0);
  histogram.bins[0] = 6;
  histogram.bins[63] = histogram.bins[std::size_t{63} * 64] = 5'000'000'000;
  return histogram;
}

TEST(HistogramCsv, HasOneLinePerPair) {
  EXPECT_EQ(histogram_csv(two_areas(), 1),
            "area_row,area_column,count\n0.1,0.1,6\n0.1,0.3,5000000000\n0.3,0.1,5000000000\n");
  EXPECT_THAT(histogram_csv(two_areas(), 10), HasSubstr("\n1,3,5000000000\n"));
}

TEST(HistogramSvg, ShowsCellsAxesAndScale) {
  const std::string svg = histogram_svg(two_areas(), 1, "leg");
  EXPECT_THAT(svg, AllOf(HasSubstr("<title>leg</title>"), HasSubstr(">0.1<"), HasSubstr(">0.3<"),
                         HasSubstr(">5000000000<")));
  EXPECT_THAT(svg, HasSubstr("#fde725\" d=\"M63 63h1v1h-1zM0 0h1v1h-1z\"")) << "the largest counts";
  EXPECT_THAT(svg, HasSubstr("d=\"M0 63h1v1h-1z\"")) << "the smallest, lower left";
  EXPECT_EQ(svg, histogram_svg(two_areas(), 1, "leg"));
}

TEST(HistogramSvg, StaysSmallAndTakesNamesOfAllKinds) {
  analysis::Histogram histogram = two_areas();
  for (std::size_t i = 0; i < histogram.bins.size(); ++i) histogram.bins[i] = 1 + i * 7919 % 100'000;
  const std::string svg = histogram_svg(histogram, 1, "<a> & \x01\xff" + std::string(500, 'x'));
  EXPECT_LT(svg.size(), 120'000U);
  EXPECT_THAT(svg, AllOf(HasSubstr("&lt;a&gt; &amp; "), Not(HasSubstr("\x01")), Not(HasSubstr("\xff"))));
}

TEST(HistogramSvg, AMeshWithoutNeighboursIsEmpty) {
  analysis::Histogram histogram = two_areas();
  histogram.bins.assign(histogram.bins.size(), 0);
  EXPECT_THAT(histogram_svg(histogram, 1, "alone"), Not(HasSubstr("<path")));
}

}  // namespace
}  // namespace scene_analyzer::report
