// histogram.h — A co-occurrence histogram as a table of exact counts and as a picture of the bins.
#pragma once

#include <string>

#include "analysis/histogram.h"

namespace scene_analyzer::report {

// "area_row,area_column,count", one line per distinct pair that occurs, ascending. Areas are the histogram's
// values times `area_scale`, printed so that reading them gives the same doubles.
std::string histogram_csv(const analysis::Histogram& histogram, double area_scale);

// An SVG heatmap of the bins, colours by the logarithm of the count; UTF-8, deterministic, at most about
// 100 kB. `title`: any text, also none that XML or a terminal would like.
std::string histogram_svg(const analysis::Histogram& histogram, double area_scale, const std::string& title);

}  // namespace scene_analyzer::report
