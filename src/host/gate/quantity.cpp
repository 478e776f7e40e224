#include "gate/quantity.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <vector>

namespace scene_analyzer::gate {
namespace {

constexpr double kCountEnd = 0x1p53;  // whole numbers below it are exact
constexpr double kTimeEnd = 1e9;      // milliseconds, more than a week

constexpr QuantityInfo count(std::string_view key, std::string_view too_much,
                             Scope scope = Scope::kGeometry) {
  return {key, scope, 0, kCountEnd, true, "", too_much, "check that nothing is missing from the asset"};
}
constexpr QuantityInfo defect(std::string_view key, std::string_view too_much, double greatest = kCountEnd) {
  return {key, Scope::kGeometry, 0, greatest, true, "", too_much, ""};
}
constexpr QuantityInfo rating(std::string_view key, std::string_view too_much, double least = 0,
                              Scope scope = Scope::kGeometry, std::string_view too_little = "") {
  return {key, scope, least, 1, false, "", too_much, too_little};
}

constexpr std::array<QuantityInfo, kQuantityCount> kInfos = {{
    count("triangles", "simplify the mesh (decimate it, or give it a coarser level of detail)"),
    count("asset_triangles", "simplify or remove the largest meshes, or place fewer copies", Scope::kAsset),
    {"file_bytes", Scope::kAsset, 0, 0x1p60, true, "bytes",
     "compress or shrink textures, remove unused data and simplify the largest meshes",
     "check that nothing is missing from the asset"},
    rating("polygons_per_planar_group", "merge coplanar triangles (limited dissolve)"),
    rating("planar_group_variation", "split the few large flat areas off, or merge coplanar triangles", 0),
    rating("relative_density", "simplify it towards the density of the asset's other meshes", -1,
           Scope::kInstance, "give it more triangles, or make the asset's other meshes coarser"),
    rating("distance", "simplify what stands this far from the eye, or move it nearer", 0, Scope::kInstance),
    rating("cooccurrence_contrast", "remesh it with triangles of more even area"),
    rating("fourier_transform", "remesh it with triangles of more even area along the surface"),
    rating("rendering_time", "make it cheaper to draw: fewer triangles, less overdraw"),
    rating("aggregate", "see its ratings with 'scene-analyzer analyze' and lower the highest one", 0,
           Scope::kInstance),
    {"rendering_time_ms", Scope::kGeometry, 0, kTimeEnd, false, "ms",
     "make it cheaper to draw: fewer triangles, less overdraw", ""},
    defect("defects.degenerate_by_index", "delete these triangles, they draw nothing"),
    defect("defects.degenerate_by_shape", "delete these triangles, or move their corners apart"),
    defect("defects.duplicate_triangles", "delete the copies (remove doubles)"),
    defect("defects.non_manifold_edges", "delete inner faces, or split the edges"),
    defect("defects.boundary_edges", "fill the holes"),
    defect("defects.inconsistent_winding", "make the faces' orientation consistent (recalculate normals)"),
    defect("defects.isolated_triangles", "weld them to their neighbours, or delete them"),
    defect("defects.unreferenced_vertices", "delete loose vertices"),
    defect("defects.non_finite_vertices", "set or delete these vertices; mend the exporter"),
    defect("defects.mergeable_vertices", "merge vertices by distance, unless seams keep them apart"),
    defect("defects.zero_area", "delete the mesh, or mend its scale", 1),
    defect("defects.far_from_origin", "center the mesh, and let its node place it", 1),
    defect("defects.total", "mend what 'scene-analyzer analyze --defects' lists"),
}};

constexpr bool has_all_keys() {
  constexpr std::string_view kPrefix = "defects.";
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
    if (kInfos[index_of(Quantity::kFirstRating) + i].key != analysis::kMetricKeys[i]) return false;
  for (std::size_t i = 0; i < analysis::kDefectCount; ++i)
    if (kInfos[index_of(Quantity::kFirstDefect) + i].key.substr(kPrefix.size()) != analysis::kDefectKeys[i])
      return false;
  return true;
}
static_assert(has_all_keys(), "ratings and defects have the keys that all outputs have, in their order");

std::string bytes_text(double bytes) {
  constexpr std::array<std::string_view, 5> kUnits = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < kUnits.size()) bytes /= 1024, ++unit;
  return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.4g} {}", bytes, kUnits[unit]);
}

}  // namespace

std::optional<analysis::Metric> rated_metric(Quantity quantity) {
  if (quantity < Quantity::kFirstRating || quantity >= Quantity::kAggregate) return std::nullopt;
  return static_cast<analysis::Metric>(index_of(quantity) - index_of(Quantity::kFirstRating));
}

std::optional<analysis::Defect> counted_defect(Quantity quantity) {
  if (quantity < Quantity::kFirstDefect || quantity >= Quantity::kDefectTotal) return std::nullopt;
  return static_cast<analysis::Defect>(index_of(quantity) - index_of(Quantity::kFirstDefect));
}

const QuantityInfo& info(Quantity quantity) {
  return kInfos[index_of(quantity)];
}

std::span<const std::string> quantity_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const QuantityInfo& one : kInfos) all.emplace_back(one.key);
    return all;
  }();
  return keys;
}

std::optional<Quantity> quantity_of(std::string_view key) {
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    if (kInfos[i].key == key) return static_cast<Quantity>(i);
  return std::nullopt;
}

std::string_view what_to_do(Quantity quantity, Bound bound) {
  if (bound == Bound::kMost) return info(quantity).too_much;
  constexpr std::string_view kOther = "raise the value, or lower the limit";
  return info(quantity).too_little.empty() ? kOther : info(quantity).too_little;
}

std::string value_text(Quantity quantity, double value) {
  if (quantity == Quantity::kFileBytes) return bytes_text(value);
  if (info(quantity).whole) return fmt::format("{:.0f}", value);
  const std::string number = fmt::format("{:.6g}", value + 0.0);
  return info(quantity).unit.empty() ? number : fmt::format("{} {}", number, info(quantity).unit);
}

}  // namespace scene_analyzer::gate
