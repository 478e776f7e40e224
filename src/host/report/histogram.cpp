#include "report/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "ratings/ratings.h"
#include "report/svg.h"

namespace scene_analyzer::report {
namespace {

using analysis::Histogram;
using analysis::kHistogramBins;

// Picture units: cells of the heatmap, and the margins around it.
constexpr std::uint32_t kCell = 8, kLeft = 44, kTop = 52, kSide = kCell * kHistogramBins;
constexpr std::uint32_t kBar = kLeft + kSide + 24, kWidth = kBar + 110, kHeight = kTop + kSide + 60;
// Shades of the picture: as many as an eye tells apart in a map, so that equal cells can share one element.
constexpr std::size_t kShades = 32;

std::size_t shade_of(std::uint64_t count, std::uint64_t most) {
  if (most <= 1) return kShades - 1;
  const double position = std::log(static_cast<double>(count)) / std::log(static_cast<double>(most));
  return static_cast<std::size_t>(std::lround(position * (kShades - 1)));
}

std::string shade_color(std::size_t shade) {
  const double position = static_cast<double>(shade) / (kShades - 1);
  return ratings::to_hex(ratings::color(position, ratings::ColorMap::kViridis));
}

// Per shade the outlines of its cells; neighbours in a row are one rectangle. Rows ascend upwards.
std::array<std::string, kShades> outlines(const std::vector<std::uint64_t>& bins, std::uint64_t most) {
  std::array<std::string, kShades> paths;
  for (std::uint32_t row = 0; row < kHistogramBins; ++row)
    for (std::uint32_t column = 0; column < kHistogramBins;) {
      const std::uint64_t* cells = bins.data() + std::size_t{row} * kHistogramBins;
      const std::uint32_t first = column++;
      if (cells[first] == 0) continue;
      const std::size_t shade = shade_of(cells[first], most);
      while (column < kHistogramBins && cells[column] > 0 && shade_of(cells[column], most) == shade) ++column;
      fmt::format_to(std::back_inserter(paths[shade]), "M{} {}h{}v1h-{}z", first, kHistogramBins - 1 - row,
                     column - first, column - first);
    }
  return paths;
}

void append_cells(std::string& out, const std::vector<std::uint64_t>& bins, std::uint64_t most) {
  out += fmt::format("<g transform=\"translate({} {}) scale({})\" shape-rendering=\"crispEdges\">\n", kLeft,
                     kTop, kCell);
  out += fmt::format("<rect width=\"{0}\" height=\"{0}\" fill=\"#f2f2f2\"/>\n", kHistogramBins);
  const auto paths = outlines(bins, most);
  for (std::size_t shade = 0; shade < kShades; ++shade)
    if (!paths[shade].empty())
      out += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", shade_color(shade), paths[shade]);
  out += "</g>\n";
}

void append_axes(std::string& out, double lowest, double highest) {
  const std::string low = fmt::format("{:.4g}", lowest), high = fmt::format("{:.4g}", highest);
  const double bottom = kTop + kSide, right = kLeft + kSide;
  append_text(out, kLeft, bottom + 18, "start", low);
  append_text(out, right, bottom + 18, "end", high);
  append_text(out, kLeft + kSide / 2.0, bottom + 40, "middle", "area of the triangle");
  append_upright(out, kLeft - 8, bottom, "start", low);
  append_upright(out, kLeft - 8, kTop, "end", high);
  append_upright(out, kLeft - 22, kTop + kSide / 2.0, "middle", "area of its neighbour");
}

void append_scale(std::string& out, std::uint64_t most) {
  const double step = static_cast<double>(kSide) / kShades;
  for (std::size_t shade = 0; shade < kShades; ++shade)
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"16\" height=\"{}\" fill=\"{}\" shape-rendering=\"crispEdges\"/>\n",
        kBar, kTop + kSide - static_cast<double>(shade + 1) * step, step, shade_color(shade));
  append_text(out, kBar + 22, kTop + 11, "start", fmt::format("{}", most));
  append_text(out, kBar + 22, kTop + kSide, "start", most > 1 ? "1" : "");
  append_text(out, kBar, kTop + kSide + 18, "start", "pairs, log scale");
  append_text(out, kBar, kTop + kSide + 40, "start", "grey: none");
}

}  // namespace

std::string histogram_csv(const Histogram& histogram, double area_scale) {
  std::string out = "area_row,area_column,count\n";
  for (const analysis::PairCount& pair : histogram.pairs)
    fmt::format_to(std::back_inserter(out), "{},{},{}\n", histogram.values[pair.row] * area_scale,
                   histogram.values[pair.column] * area_scale, pair.count);
  return out;
}

std::string histogram_svg(const Histogram& histogram, double area_scale, const std::string& title) {
  const std::uint64_t most = *std::ranges::max_element(histogram.bins);
  std::string out = svg_head(kWidth, kHeight, kLeft, title);
  append_text(out, kLeft, 42, "start", "How often triangles of two areas share an edge");
  append_cells(out, histogram.bins, most);
  append_axes(out, histogram.values.front() * area_scale, histogram.values.back() * area_scale);
  append_scale(out, most);
  return out + "</svg>\n";
}

}  // namespace scene_analyzer::report
