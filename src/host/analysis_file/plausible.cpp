#include "analysis_file/plausible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

namespace scene_analyzer::analysis_file {
namespace {

using Reason = std::optional<std::string>;

constexpr std::array<std::string_view, 6> kDeviceTypes = {"",        "discrete", "integrated",
                                                          "virtual", "cpu",      "other"};
constexpr std::array<std::string_view, 6> kAxes = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
// Sums of rounded terms may pass the ends of [0,1] by a little.
constexpr double kRounding = 1e-6;

template <typename Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_rating(const std::optional<double>& value) {
  return !value || (*value >= -kRounding && *value <= 1 + kRounding);  // false for NaN
}

bool is_length(double value) {
  return std::isfinite(value) && value >= 0;
}

bool at_most(const std::optional<std::uint64_t>& value, std::uint64_t limit) {
  return !value || *value <= limit;
}

Reason parameters_reason(const analysis::Parameters& parameters) {
  if (!(parameters.alpha_degrees >= 0 && parameters.alpha_degrees <= 180)) return "alpha outside [0, 180]";
  if (parameters.dim < 2) return "dim below 2";
  if (!is_length(parameters.weld_tolerance)) return "weld tolerance negative or not finite";
  if (parameters.steps < 1) return "steps below 1";
  return std::nullopt;
}

Reason signal_reason(const analysis::GeometryAnalysis& geometry) {
  if (geometry.signal.has_value() != geometry.fourier_transform.has_value())
    return "of signal and Fourier rating only one";
  if (!geometry.signal) return std::nullopt;
  const analysis::SignalSummary& signal = *geometry.signal;
  if (signal.length > geometry.triangles) return "a signal of more triangles than there are";
  if (signal.length > 0 && signal.start_triangle >= geometry.source_triangles)
    return "a start triangle that does not exist";
  if (!is_length(signal.mean_distance)) return "mean distance negative or not finite";
  if (!is_length(signal.gap)) return "gap negative or not finite";
  return std::nullopt;
}

Reason defect_reason(const analysis::FoundDefect& one, const analysis::GeometryAnalysis& geometry) {
  using analysis::DefectPlace;
  const DefectPlace place = place_of(one.defect);
  if (one.count == 0) return "a defect that was not found";
  if (place == DefectPlace::kNone) {
    if (one.count != 1 || !one.places.empty()) return "a defect of a whole mesh more than once or at a place";
    return std::nullopt;
  }
  if (one.places.empty() ||
      one.places.size() > std::min<std::uint64_t>(one.count, analysis::kMostDefectPlaces))
    return "more or fewer places of a defect than there are";
  // Strictly: no place is named twice.
  if (std::ranges::adjacent_find(one.places, std::greater_equal()) != one.places.end())
    return "places of a defect in no order";
  if (place == DefectPlace::kTriangle && one.places.back() >= geometry.source_triangles)
    return "a defect at a triangle that does not exist";
  return std::nullopt;
}

// What is counted twice is counted the same, and by the sum of its parts.
bool agree(const analysis::Defects& defects, const analysis::GeometryAnalysis& geometry) {
  using analysis::Defect;
  const std::uint64_t by_index = defects.count(Defect::kDegenerateByIndex);
  return by_index <= geometry.degenerate_triangles &&
         defects.count(Defect::kDegenerateByShape) == geometry.degenerate_triangles - by_index &&
         defects.count(Defect::kDuplicateTriangles) <= geometry.triangles &&
         defects.count(Defect::kNonManifoldEdges) == geometry.non_manifold_edges.value_or(0) &&
         defects.count(Defect::kBoundaryEdges) == geometry.boundary_edges.value_or(0) &&
         defects.count(Defect::kIsolatedTriangles) == geometry.isolated_triangles.value_or(0) &&
         (defects.count(Defect::kZeroArea) == 1) ==
             (geometry.triangles == 0 && geometry.source_triangles > 0);
}

Reason defects_reason(const analysis::GeometryAnalysis& geometry) {
  if (!geometry.defects) return std::nullopt;
  const auto& found = geometry.defects->found;
  if (std::ranges::adjacent_find(found, std::greater_equal(), &analysis::FoundDefect::defect) != found.end())
    return "kinds of defects in no order";
  for (const analysis::FoundDefect& one : found)
    if (Reason reason = defect_reason(one, geometry)) return reason;
  if (!agree(*geometry.defects, geometry)) return "defects that contradict the other counts";
  return std::nullopt;
}

Reason geometry_reason(const analysis::GeometryAnalysis& geometry) {
  const std::uint64_t n = geometry.triangles;
  const bool counted =
      geometry.source_triangles >= n && geometry.source_triangles - n == geometry.degenerate_triangles;
  if (geometry.not_analysed.empty() && !counted)
    return "source triangles are not the sum of kept and degenerate ones";
  if (!is_length(geometry.surface_area)) return "surface area negative or not finite";
  if (!at_most(geometry.planar_groups, n) || !at_most(geometry.largest_planar_group, n) ||
      !at_most(geometry.components, n) || !at_most(geometry.isolated_triangles, n) ||
      !at_most(geometry.area_classes, n))
    return "more parts than triangles";
  const std::uint64_t sides = n > UINT64_MAX / 3 ? UINT64_MAX : 3 * n;
  if (!at_most(geometry.boundary_edges, sides) || !at_most(geometry.non_manifold_edges, sides))
    return "more edges than sides of triangles";
  if (!is_rating(geometry.polygons_per_planar_group) || !is_rating(geometry.planar_group_variation) ||
      !is_rating(geometry.cooccurrence_contrast) || !is_rating(geometry.fourier_transform))
    return "a rating outside [0, 1]";
  if (Reason reason = defects_reason(geometry)) return reason;
  return signal_reason(geometry);
}

Reason instance_reason(const analysis::InstanceAnalysis& instance, std::size_t geometries) {
  if (instance.geometry >= geometries)
    return "geometry " + std::to_string(instance.geometry) + " of " + std::to_string(geometries);
  if (!is_length(instance.area_scale)) return "area scale negative or not finite";
  if (!instance.bounds) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = instance.bounds->min[axis];
    const double high = instance.bounds->max[axis];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) return "bounds inverted or not finite";
  }
  return std::nullopt;
}

Reason file_reason(const analysis::FileFingerprint& file) {
  if (file.path.empty() || file.path.find('\0') != std::string::npos) return "no usable path";
  if (!file.found && (file.size != 0 || file.hash[0] != 0 || file.hash[1] != 0))
    return "contents without a file";
  return std::nullopt;
}

bool is_count(const std::optional<double>& value) {
  return !value || is_length(*value);
}

Reason time_reason(const analysis::RenderingTime& time) {
  if (time.mean_ns == 0) return std::nullopt;
  if (!is_length(time.mean_ns) || !is_length(time.fastest_ns) || !is_length(time.slowest_ns) ||
      time.fastest_ns > time.slowest_ns)
    return "times negative, not finite or in no order";
  if (!is_count(time.confidence_ns)) return "an interval negative or not finite";
  if (time.rounds < 1 || time.rotations < 1) return "a time without a draw";
  if (!is_count(time.vertex_invocations) || !is_count(time.fragment_invocations) || !is_count(time.overdraw))
    return "counts negative or not finite";
  return std::nullopt;
}

// The first reason among `items`, with what and which.
template <typename Items, typename Judge>
Reason first_reason(const char* what, const Items& items, Judge judge) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (const Reason reason = judge(items[i]))
      return std::string(what) + " " + std::to_string(i) + ": " + *reason;
  return std::nullopt;
}

Reason timing_reason(const analysis::RenderTiming& timing, std::size_t geometries) {
  const analysis::RenderTiming::Conditions& conditions = timing.conditions;
  if (conditions.device.name.empty() || !contains(kDeviceTypes, conditions.device.type))
    return "no device, or one of an unknown type";
  if (conditions.width < 1 || conditions.height < 1 || conditions.steps < 1)
    return "no picture or no rotation";
  if (!is_length(timing.budget_seconds)) return "a budget negative or not finite";
  if (!is_length(timing.timestamp_period_ns)) return "a clock's period negative or not finite";
  if (timing.times.size() != geometries) return "not one time per geometry";
  return first_reason("time", timing.times, time_reason);
}

}  // namespace

Reason implausible(const analysis::AssetAnalysis& analysis) {
  if (Reason reason = parameters_reason(analysis.parameters)) return reason;
  // Files without the Fourier rating may be older than the parameter.
  if (analysis.computed[analysis::index_of(analysis::Metric::kFourierTransform)] &&
      analysis.parameters.start_searches < 1)
    return "start searches below 1";
  if (!contains(kDeviceTypes, analysis.device.type))
    return "unknown device type '" + analysis.device.type + "'";
  if (analysis.up_axis && !contains(kAxes, *analysis.up_axis))
    return "unknown axis '" + *analysis.up_axis + "'";
  if (analysis.unit_scale && !std::isfinite(*analysis.unit_scale)) return "unit scale not finite";
  if (analysis.files.empty() || !analysis.files.front().found) return "no fingerprint of the asset";
  if (Reason reason = first_reason("file", analysis.files, file_reason)) return reason;
  if (Reason reason = first_reason("geometry", analysis.geometries, geometry_reason)) return reason;
  const std::size_t geometries = analysis.geometries.size();
  if (analysis.computed[analysis::index_of(analysis::Metric::kRenderingTime)] == analysis.timings.empty())
    return "of rendering times and their metric only one";
  if (Reason reason = first_reason("render timing", analysis.timings, [geometries](const auto& timing) {
        return timing_reason(timing, geometries);
      }))
    return reason;
  return first_reason("instance", analysis.instances,
                      [geometries](const auto& instance) { return instance_reason(instance, geometries); });
}

}  // namespace scene_analyzer::analysis_file
