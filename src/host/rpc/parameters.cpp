#include "rpc/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nearest.h"
#include "render_timing/render_timer.h"

namespace scene_analyzer::rpc {
namespace {

using analysis::Metric;
using analysis::MetricSet;
using pictures::Subject;
using service::Reason;
using service::Refusal;

constexpr std::uint32_t kMostPixels = 16384;                    // a side
constexpr std::size_t kLongestName = 64;                        // that is compared with those we know
constexpr std::uint32_t kLeastWidth = 240, kLeastHeight = 120;  // below it no legend can be read
constexpr std::array<std::string_view, 4> kMapNames = {"thesis", "viridis", "cividis", "coolwarm"};

template <typename T>
T in_range(const char* field, T value, T least, T greatest, const char* raised_by = nullptr) {
  if (value >= least && value <= greatest) return value;  // NaN is not
  throw Refusal(
      Reason::kInvalid,
      fmt::format(
          "{}: {} is not in [{}, {}]{}", field, value, least, greatest,
          raised_by && value > greatest ? fmt::format("; the service's {} allows no more", raised_by) : ""));
}

[[noreturn]] void refuse_name(const char* field, const std::string& text,
                              const std::vector<std::string>& known) {
  if (text.size() > kLongestName)
    throw Refusal(Reason::kInvalid, fmt::format("{}: a name of {} bytes is unknown", field, text.size()));
  const std::string meant = nearest(text, known);
  throw Refusal(Reason::kInvalid, fmt::format("{}: '{}' is unknown{}", field, text,
                                              meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
}

std::vector<std::string> metric_names() {
  return {analysis::kMetricKeys.begin(), analysis::kMetricKeys.end()};
}

Metric read_metric(const char* field, const std::string& key) {
  if (const auto metric = analysis::metric_of(key)) return *metric;
  refuse_name(field, key, metric_names());
}

template <typename Keys>
MetricSet read_metrics(const char* field, const Keys& keys, MetricSet defaults) {
  if (keys.empty()) return defaults;
  MetricSet metrics;
  for (const std::string& key : keys) metrics.set(index_of(read_metric(field, key)));
  return metrics;
}

mesh::Vector3 read_point(const char* field, const v1::Vector3& point) {
  if (!std::isfinite(point.x()) || !std::isfinite(point.y()) || !std::isfinite(point.z()))
    throw Refusal(Reason::kInvalid, fmt::format("{}: its coordinates are not all finite", field));
  return {point.x(), point.y(), point.z()};
}

pictures::Content read_content(const v1::RenderParameters& message) {
  pictures::Content content;
  content.relative = message.rating().relative();
  content.emphasize_extremes = message.emphasize_extremes();
  const std::string& subject = message.subject();
  if (subject == "planar_groups") {
    content.subject = Subject::kPlanarGroups;
  } else if (subject == "own_colours") {
    content.subject = Subject::kOwnColors;
  } else if (const auto metric = analysis::metric_of(subject)) {
    content.subject = Subject::kMetric;
    content.metric = *metric;
  } else if (!subject.empty() && subject != "aggregate") {
    std::vector<std::string> known = metric_names();
    known.insert(known.end(), {"aggregate", "planar_groups", "own_colours"});
    refuse_name("subject", subject, known);
  }
  if (content.emphasize_extremes && (subject == "planar_groups" || subject == "own_colours"))
    throw Refusal(Reason::kInvalid, fmt::format("emphasize_extremes: '{}' has no extreme meshes", subject));
  if (const std::string& map = message.color_map(); !map.empty()) {
    const auto* found = std::ranges::find(kMapNames, map);
    if (found == kMapNames.end()) refuse_name("color_map", map, {kMapNames.begin(), kMapNames.end()});
    content.map = static_cast<ratings::ColorMap>(found - kMapNames.begin());
  }
  return content;
}

}  // namespace

MetricSet quick_metrics() {
  return MetricSet().set().reset(index_of(Metric::kRenderingTime));
}

pipeline::Options read_measuring(const v1::MeasuringParameters& message, MetricSet default_metrics,
                                 const Backend& backend) {
  pipeline::Options options;
  options.use_analysis_files = false;
  options.store = backend.store;
  options.fingerprint_files = true;  // for the content key
  options.import_limits = backend.limits.import;
  options.this_device_only = true;
  options.timing_budget = backend.limits.timing_budget;
  options.metrics = read_metrics("measuring.metrics", message.metrics(), default_metrics);
  analysis::Parameters& parameters = options.parameters;
  parameters.start_searches = std::min(parameters.start_searches, backend.limits.start_searches);
  constexpr auto kMost32 = std::numeric_limits<std::uint32_t>::max();
  if (message.has_alpha_degrees())
    parameters.alpha_degrees = in_range("measuring.alpha_degrees", message.alpha_degrees(), 0.0, 180.0);
  if (message.has_dim()) parameters.dim = in_range("measuring.dim", message.dim(), 2U, kMost32);
  if (message.has_weld_tolerance())
    parameters.weld_tolerance = in_range("measuring.weld_tolerance", message.weld_tolerance(), 0.0,
                                         std::numeric_limits<double>::max());
  if (message.has_start_searches())
    parameters.start_searches =
        in_range<std::uint64_t>("measuring.start_searches", message.start_searches(), 1,
                                backend.limits.start_searches, "--max-start-searches");
  if (message.has_steps())
    parameters.steps =
        in_range<std::uint32_t>("measuring.steps", message.steps(), 1, render_timing::kMostSteps);
  if (message.has_timing_width())
    options.timing_width = in_range("measuring.timing_width", message.timing_width(), 1U, kMostPixels);
  if (message.has_timing_height())
    options.timing_height = in_range("measuring.timing_height", message.timing_height(), 1U, kMostPixels);
  if (message.has_timing_budget_seconds())
    options.timing_budget = in_range("measuring.timing_budget_seconds", message.timing_budget_seconds(),
                                     0.001, backend.limits.timing_budget, "--timing-budget");
  return options;
}

ratings::Options read_rating(const v1::RatingParameters& message) {
  ratings::Options options;
  options.metrics = read_metrics("rating.metrics", message.metrics(), options.metrics);
  options.relative = message.relative();
  if (!message.weights().empty()) {
    options.weights.fill(0);
    for (const auto& [key, weight] : message.weights())
      options.weights[index_of(read_metric("rating.weights", key))] =
          in_range("rating.weights", weight, 0.0, std::numeric_limits<double>::max());
    if (std::ranges::all_of(options.weights, [](double weight) { return weight == 0; }))
      throw Refusal(Reason::kInvalid, "rating.weights: all are 0; at least one must be greater");
  }
  if (message.has_eye()) options.eye = read_point("rating.eye", message.eye());
  return options;
}

service::PictureOrder read_picture(const v1::RenderParameters& message) {
  service::PictureOrder order;
  order.content = read_content(message);
  order.rating = read_rating(message.rating());
  if (message.width() != 0) order.format.width = in_range("width", message.width(), kLeastWidth, kMostPixels);
  if (message.height() != 0)
    order.format.height = in_range("height", message.height(), kLeastHeight, kMostPixels);
  if (message.has_target()) order.format.target = read_point("target", message.target());
  return order;
}

MetricSet metrics_of(const service::PictureOrder& picture) {
  switch (picture.content.subject) {
    case Subject::kMetric:
      return MetricSet().set(index_of(picture.content.metric));
    case Subject::kAggregate:
      return quick_metrics() & picture.rating.metrics;
    case Subject::kPlanarGroups:
    case Subject::kOwnColors:
      break;
  }
  return MetricSet().set(index_of(Metric::kDistance));  // which takes nothing but bounds
}

}  // namespace scene_analyzer::rpc
