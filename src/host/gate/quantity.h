// quantity.h — What a budget can limit: names, ranges, and what to do about too much of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "analysis/defects.h"
#include "analysis/metric.h"

namespace scene_analyzer::gate {

// Ratings and kinds of defects follow their first one in their own order.
enum class Quantity : std::uint8_t {
  kTriangles,       // of a mesh, those with an area
  kAssetTriangles,  // of all meshes, each as often as it stands in the asset
  kFileBytes,       // of the asset and all files that it refers to
  kFirstRating,
  kAggregate = kFirstRating + analysis::kMetricCount,
  kRenderingTime,  // milliseconds per draw
  kFirstDefect,
  kDefectTotal = kFirstDefect + analysis::kDefectCount
};
inline constexpr std::size_t kQuantityCount = static_cast<std::size_t>(Quantity::kDefectTotal) + 1;

constexpr std::size_t index_of(Quantity quantity) {
  return static_cast<std::size_t>(quantity);
}
constexpr Quantity quantity_of(analysis::Metric metric) {
  return static_cast<Quantity>(index_of(Quantity::kFirstRating) + index_of(metric));
}
constexpr Quantity quantity_of(analysis::Defect defect) {
  return static_cast<Quantity>(index_of(Quantity::kFirstDefect) + index_of(defect));
}
std::optional<analysis::Metric> rated_metric(Quantity quantity);    // of a rating
std::optional<analysis::Defect> counted_defect(Quantity quantity);  // of one kind of defect

// What has a value of its own. Instances of one geometry share its value.
enum class Scope : std::uint8_t { kGeometry, kInstance, kAsset };

enum class Bound : std::uint8_t { kMost, kLeast };
constexpr std::string_view key_of(Bound bound) {
  return bound == Bound::kMost ? "max" : "min";
}

struct QuantityInfo {
  std::string_view key;  // in budgets, baselines and JSON
  Scope scope = Scope::kGeometry;
  double least = 0, greatest = 0;  // that a value can have
  bool whole = false;
  std::string_view unit;        // for people; may be empty
  std::string_view too_much;    // what to do, in the imperative
  std::string_view too_little;  // the same; empty where nobody wants more of it
};
const QuantityInfo& info(Quantity quantity);

std::optional<Quantity> quantity_of(std::string_view key);
// In the order of Quantity.
std::span<const std::string> quantity_keys();

std::string_view what_to_do(Quantity quantity, Bound bound);
// "51200", "5.2 MiB", "0.8312", "1.25 ms".
std::string value_text(Quantity quantity, double value);

}  // namespace scene_analyzer::gate
