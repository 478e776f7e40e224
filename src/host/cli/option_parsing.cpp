#include "cli/option_parsing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/byte_text.h"
#include "base/error.h"

namespace scene_analyzer::cli {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view allowed) {
  throw UsageError(fmt::format("--{}: '{}' is not {}", option, text, allowed));
}

// "a,,b" has three parts, the second empty; "" has one.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

// std::from_chars knows no leading plus and accepts "nan" and "inf"; users write the one and never mean the
// others.
template <typename Number>
std::optional<Number> read(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::string range_text(double least, double greatest, std::string_view unit) {
  const std::string suffix = unit.empty() ? "" : fmt::format(" {}", unit);
  if (greatest == std::numeric_limits<double>::max()) return fmt::format("a number >= {}{}", least, suffix);
  return fmt::format("a number in [{}, {}]{}", least, greatest, suffix);
}

std::string known_keys() {
  return fmt::format("{}", fmt::join(analysis::kMetricKeys, ", "));
}

analysis::Metric metric_or_refuse(std::string_view option, std::string_view key) {
  if (const auto metric = analysis::metric_of(key)) return *metric;
  const std::vector<std::string> keys(analysis::kMetricKeys.begin(), analysis::kMetricKeys.end());
  const std::string meant = nearest(key, keys);
  throw UsageError(fmt::format("--{}: '{}' is not a metric{}; known are {}", option, key,
                               meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant), known_keys()));
}

}  // namespace

double parse_number(std::string_view option, std::string_view text, double least, double greatest,
                    std::string_view unit) {
  const auto value = read<double>(text);
  if (!value || *value < least || *value > greatest) refuse(option, text, range_text(least, greatest, unit));
  return *value;
}

std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t least,
                            std::uint64_t greatest) {
  const auto value = read<std::uint64_t>(text);
  if (!value || *value < least || *value > greatest)
    refuse(option, text, fmt::format("a whole number in [{}, {}]", least, greatest));
  return *value;
}

mesh::Vector3 parse_vector3(std::string_view option, std::string_view text) {
  const auto parts = split(text, ',');
  mesh::Vector3 vector{};
  bool good = parts.size() == vector.size();
  for (std::size_t i = 0; good && i < vector.size(); ++i) {
    const auto value = read<double>(parts[i]);
    good = value.has_value();
    vector[i] = value.value_or(0);
  }
  if (!good) refuse(option, text, "three finite numbers X,Y,Z without spaces");
  return vector;
}

std::pair<std::uint32_t, std::uint32_t> parse_pixels(std::string_view option, std::string_view text) {
  constexpr std::uint32_t kMostPixels = 16384;
  const auto parts = split(text, 'x');
  const auto pixels = [&](std::size_t i) {
    const auto value = parts.size() == 2 ? read<std::uint32_t>(parts[i]) : std::nullopt;
    if (!value || *value < 1 || *value > kMostPixels)
      refuse(option, text,
             fmt::format("WIDTHxHEIGHT in pixels, each from 1 to {}, like 512x512", kMostPixels));
    return *value;
  };
  return {pixels(0), pixels(1)};
}

analysis::MetricSet parse_metrics(std::string_view option, std::string_view text) {
  analysis::MetricSet metrics;
  for (const std::string_view key : split(text, ',')) {
    const std::size_t metric = index_of(metric_or_refuse(option, key));
    if (metrics[metric]) throw UsageError(fmt::format("--{}: '{}' is named twice", option, key));
    metrics.set(metric);
  }
  return metrics;
}

std::array<double, analysis::kMetricCount> parse_weights(std::string_view option, std::string_view text) {
  std::array<double, analysis::kMetricCount> weights{};
  analysis::MetricSet named;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) refuse(option, part, "KEY=WEIGHT");
    const std::string_view key = part.substr(0, equals);
    const std::size_t metric = index_of(metric_or_refuse(option, key));
    if (named[metric]) throw UsageError(fmt::format("--{}: '{}' is named twice", option, key));
    named.set(metric);
    const auto weight = read<double>(part.substr(equals + 1));
    if (!weight || *weight < 0) refuse(option, part, "KEY=WEIGHT with a number WEIGHT >= 0");
    weights[metric] = *weight;
  }
  if (std::ranges::none_of(weights, [](double weight) { return weight > 0; }))
    throw UsageError(fmt::format("--{}: '{}' has no weight above 0; at least one is needed", option, text));
  return weights;
}

std::uint64_t parse_size(std::string_view option, std::string_view text) {
  const auto bytes = bytes_of(text);
  if (!bytes) refuse(option, text, fmt::format("{} (K, M, G, T are powers of 1024)", kByteExamples));
  return *bytes;
}

}  // namespace scene_analyzer::cli
