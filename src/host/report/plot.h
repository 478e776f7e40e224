// plot.h — A diagram of a row of values over their index, however long: axes, and the values as steps or,
// where there are more of them than columns of the picture, as a band from the least to the greatest of each
// column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::report {

struct Extremes {
  double least = 0, greatest = 0;
};
// `values` cut into at most `columns` >= 1 runs of nearly equal length. Cost: one pass.
std::vector<Extremes> envelope(std::span<const double> values, std::size_t columns);

struct Plot {
  double left = 0, top = 0, height = 0;  // of the area between the axes, picture units
  std::uint64_t first = 0;               // index of the first value
  std::string x_label, y_label;
  std::string color;
  double least_top = 0;  // what the y axis reaches at least: keeps noise from filling the diagram
};
inline constexpr std::size_t kPlotWidth = 720;  // picture units, and columns at most

// Values are >= 0, at least one; each is multiplied by `scale`. At most about 50 kB.
void append_plot(std::string& out, const Plot& plot, std::span<const double> values, double scale);

}  // namespace scene_analyzer::report
