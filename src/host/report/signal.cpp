#include "report/signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/gap_text.h"
#include "report/plot.h"
#include "report/svg.h"

namespace scene_analyzer::report {
namespace {

constexpr std::uint32_t kLeft = 96, kWidth = kLeft + kPlotWidth + 36, kHeight = 680;
constexpr double kSignalTop = 132, kSpectrumTop = 420, kPlotHeight = 196;
constexpr double kCaption = 12;  // above a diagram
// Rounding leaves magnitudes of this share where all areas are equal; they are to look like nothing.
constexpr double kNoise = 1e-9;

std::string numbered(const char* head, std::span<const double> values, double scale) {
  std::string out = head;
  for (std::size_t i = 0; i < values.size(); ++i)
    fmt::format_to(std::back_inserter(out), "{},{}\n", i, values[i] * scale);
  return out;
}

std::string rating_line(const analysis::GeometryAnalysis& geometry, std::size_t length) {
  std::string line = fmt::format("N = {} triangles with a neighbour", length);
  if (geometry.fourier_transform)
    line += fmt::format(", R_ft = {}{:.4f}", geometry.signal && geometry.signal->gap > 0 ? "~" : "",
                        *geometry.fourier_transform);
  return line;
}

void append_start(std::string& out, const analysis::SignalSummary& signal, double area_scale) {
  append_text(out, kLeft, 64, "start",
              fmt::format("Start triangle {}, mean distance to the others {:.4g} units",
                          signal.start_triangle, signal.mean_distance * std::sqrt(area_scale)));
  append_text(
      out, kLeft, 84, "start",
      signal.gap > 0
          ? fmt::format("Gap {}: in some part another triangle may lie that much farther from the others",
                        gap_percent(signal.gap))
          : "Gap 0: proven to be the triangle farthest from the others");
}

std::string signal_caption(std::size_t length) {
  std::string caption = "Signal: the triangles' areas, by distance from the start triangle";
  if (length > kPlotWidth) caption += "; per column the least to the greatest";
  return caption;
}

std::string spectrum_caption(std::span<const double> magnitudes, double scale) {
  const auto alternating = magnitudes.subspan(1);
  const auto largest = std::ranges::max_element(alternating);
  return fmt::format(
      "Spectrum: largest |X_k| = {:.4g} at k = {}; not drawn |X_0| = {:.4g}, the sum of the areas",
      *largest * scale, largest - alternating.begin() + 1, magnitudes[0] * scale);
}

}  // namespace

std::string signal_csv(std::span<const double> areas, double area_scale) {
  return numbered("index,area\n", areas, area_scale);
}

std::string spectrum_csv(std::span<const double> magnitudes, double area_scale) {
  return numbered("k,magnitude\n", magnitudes, area_scale);
}

std::string signal_svg(const analysis::SignalSpectrum& signal, const analysis::GeometryAnalysis& geometry,
                       double area_scale, const std::string& title) {
  std::string out = svg_head(kWidth, kHeight, kLeft, title);
  append_text(out, kLeft, 44, "start", rating_line(geometry, signal.areas.size()));
  if (signal.areas.empty()) return out + "</svg>\n";  // no triangle has a neighbour: nothing to draw
  if (geometry.signal) append_start(out, *geometry.signal, area_scale);
  append_text(out, kLeft, kSignalTop - kCaption, "start", signal_caption(signal.areas.size()));
  append_plot(out,
              {.left = kLeft,
               .top = kSignalTop,
               .height = kPlotHeight,
               .first = 0,
               .x_label = "place in the order",
               .y_label = "area, square units",
               .color = "#1f5fa8"},
              signal.areas, area_scale);
  if (signal.magnitudes.size() < 2) return out + "</svg>\n";
  append_text(out, kLeft, kSpectrumTop - kCaption, "start", spectrum_caption(signal.magnitudes, area_scale));
  append_plot(out,
              {.left = kLeft,
               .top = kSpectrumTop,
               .height = kPlotHeight,
               .first = 1,
               .x_label = "k: changes along the whole signal",
               .y_label = "|X_k|, square units",
               .color = "#a8401f",
               .least_top = kNoise * signal.magnitudes[0]},
              signal.magnitudes.subspan(1), area_scale);
  return out + "</svg>\n";
}

}  // namespace scene_analyzer::report
