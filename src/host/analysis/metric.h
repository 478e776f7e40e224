// metric.h — The seven metrics in the order of the specification's table, and their keys.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string_view>

namespace scene_analyzer::analysis {

enum class Metric : std::size_t {
  kPolygonsPerPlanarGroup,
  kPlanarGroupVariation,
  kRelativeDensity,
  kDistance,
  kCooccurrenceContrast,
  kFourierTransform,
  kRenderingTime,
};
inline constexpr std::size_t kMetricCount = 7;

// The name in JSON, CSV, protobuf, command line and code.
inline constexpr std::array<std::string_view, kMetricCount> kMetricKeys = {
    "polygons_per_planar_group", "planar_group_variation", "relative_density", "distance",
    "cooccurrence_contrast",     "fourier_transform",      "rendering_time"};
// Column heads of narrow tables, the thesis' symbols.
inline constexpr std::array<std::string_view, kMetricCount> kMetricSymbols = {
    "R_pppg", "R_pgv", "R_rd", "R_d", "R_ccm", "R_ft", "R_rt"};
// For people.
inline constexpr std::array<std::string_view, kMetricCount> kMetricNames = {
    "Polygons per planar group", "Planar group variation", "Relative density", "Distance",
    "Co-occurrence contrast",    "Fourier transform",      "Rendering time"};

using MetricSet = std::bitset<kMetricCount>;

constexpr std::size_t index_of(Metric metric) {
  return static_cast<std::size_t>(metric);
}

// The metric of a key, or nothing for an unknown key.
inline std::optional<Metric> metric_of(std::string_view key) {
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (kMetricKeys[i] == key) return static_cast<Metric>(i);
  return std::nullopt;
}

}  // namespace scene_analyzer::analysis
