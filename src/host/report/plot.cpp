#include "report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/svg.h"

namespace scene_analyzer::report {
namespace {

constexpr double kWidth = kPlotWidth;
constexpr double kRowsOfLabels[] = {18, 38};  // below the area: indices, what they are

// The least of 1, 2 and 5 times a power of ten that is at least `value` > 0.
double nice_step(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value * (1 - 1e-12)) return factor * power;
  return 10 * power;
}

struct Scale {
  double step = 0, top = 0;  // of the y axis, from 0
};

Scale scale_for(double greatest) {
  // Overflowing coordinates and meshes scaled to nothing still get axes.
  const double highest = greatest > 1e-300 ? std::min(greatest, 1e300) : 1;
  const double step = nice_step(highest / 4);
  return {step, step * std::ceil(highest / step * (1 - 1e-12))};
}

// One outline of steps: its way along the columns at one of their ends.
void append_steps(std::string& out, const Plot& plot, std::span<const Extremes> columns,
                  double Extremes::*end, double factor, bool backwards) {
  const std::size_t count = columns.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = backwards ? count - 1 - i : i;
    const double share = columns[column].*end * factor;
    const double y = plot.top + plot.height * (1 - (share > 0 ? std::min(share, 1.0) : 0));
    const std::size_t edge = backwards ? column : column + 1;
    const double x = plot.left + kWidth * static_cast<double>(edge) / static_cast<double>(count);
    fmt::format_to(std::back_inserter(out), "V{:.1f}H{:.1f}", y, x);
  }
}

void append_values(std::string& out, const Plot& plot, std::span<const Extremes> columns, double factor) {
  const double bottom = plot.top + plot.height;
  out += fmt::format("<path fill=\"{}\" fill-opacity=\"0.25\" d=\"M{} {}", plot.color, plot.left, bottom);
  append_steps(out, plot, columns, &Extremes::least, factor, false);
  out += fmt::format("V{}z\"/>\n<path fill=\"{}\" stroke=\"{}\" d=\"M{} {}", bottom, plot.color, plot.color,
                     plot.left, bottom);
  append_steps(out, plot, columns, &Extremes::greatest, factor, false);
  append_steps(out, plot, columns, &Extremes::least, factor, true);
  out += "\"/>\n";
}

void append_line(std::string& out, double x1, double y1, double x2, double y2, const char* color) {
  out += fmt::format("<path stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", color, x1, y1, x2, y2);
}

void append_y_axis(std::string& out, const Plot& plot, const Scale& scale) {
  const long ticks = std::lround(scale.top / scale.step);
  for (long i = 0; i <= ticks; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(ticks);
    const double y = plot.top + plot.height * (1 - share);
    append_line(out, plot.left, y, plot.left + kWidth, y, i == 0 ? "#222" : "#ddd");
    append_text(out, plot.left - 8, y + 4, "end", fmt::format("{:.4g}", static_cast<double>(i) * scale.step));
  }
  append_upright(out, plot.left - 74, plot.top + plot.height / 2, "middle", plot.y_label);
}

// Indices stand below the middle of their steps.
void append_x_axis(std::string& out, const Plot& plot, std::size_t count) {
  const auto step = static_cast<std::uint64_t>(std::max(1.0, nice_step(static_cast<double>(count) / 8)));
  const double bottom = plot.top + plot.height;
  const std::uint64_t end = plot.first + count;
  for (std::uint64_t index = plot.first; index < end; index = (index / step + 1) * step) {
    const double place = static_cast<double>(index - plot.first) + 0.5;
    const double x = plot.left + kWidth * place / static_cast<double>(count);
    append_line(out, x, bottom, x, bottom + 5, "#222");
    append_text(out, x, bottom + kRowsOfLabels[0], "middle", fmt::format("{}", index));
  }
  append_text(out, plot.left + kWidth / 2, bottom + kRowsOfLabels[1], "middle", plot.x_label);
}

}  // namespace

std::vector<Extremes> envelope(std::span<const double> values, std::size_t columns) {
  std::vector<Extremes> result;
  const std::size_t count = std::min(columns, values.size());
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * values.size() / count;
    const std::size_t end = (i + 1) * values.size() / count;
    const auto [least, greatest] = std::ranges::minmax(values.subspan(begin, end - begin));
    result.push_back({least, greatest});
  }
  return result;
}

void append_plot(std::string& out, const Plot& plot, std::span<const double> values, double scale) {
  const std::vector<Extremes> columns = envelope(values, kPlotWidth);
  const double greatest = std::ranges::max(columns, {}, &Extremes::greatest).greatest;
  const Scale axis = scale_for(std::max(greatest, plot.least_top) * scale);
  append_y_axis(out, plot, axis);
  append_values(out, plot, columns, scale / axis.top);
  append_x_axis(out, plot, values.size());
}

}  // namespace scene_analyzer::report
