#include "report/document.h"

#include <algorithm>
#include <cmath>

namespace scene_analyzer::report {
namespace {

using analysis::DeviceStamp;
using analysis::kMetricCount;
using analysis::kMetricKeys;
using nlohmann::ordered_json;

ordered_json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value + 0.0;  // -0 + 0 = 0
}

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  if (!value) return nullptr;
  if constexpr (std::is_same_v<T, double>)
    return number(*value);
  else
    return *value;
}

ordered_json text_or_null(const std::string& text) {
  return text.empty() ? ordered_json() : ordered_json(text);
}

// A point that is not finite in one coordinate is no point.
ordered_json point(const std::optional<mesh::Vector3>& value) {
  if (!value) return nullptr;
  ordered_json result = ordered_json::array();
  for (const double coordinate : *value) {
    if (!std::isfinite(coordinate)) return nullptr;
    result.push_back(number(coordinate));
  }
  return result;
}

ordered_json box(const std::optional<analysis::Bounds>& bounds) {
  if (!bounds) return nullptr;
  ordered_json min = point(bounds->min);
  ordered_json max = point(bounds->max);
  if (min.is_null() || max.is_null()) return nullptr;
  return {{"min", std::move(min)}, {"max", std::move(max)}};
}

ordered_json by_key(const ratings::OptionalRatings& ratings) {
  ordered_json result = ordered_json::object();
  for (std::size_t i = 0; i < kMetricCount; ++i) result[std::string(kMetricKeys[i])] = or_null(ratings[i]);
  return result;
}

// The device that computed the results: when all came from analysis files, the one they name, if they agree.
// So the first and the second run of a command print the same document.
DeviceStamp device_of(const SceneReport& report) {
  if (!report.device.name.empty() || report.assets.empty()) return report.device;
  const DeviceStamp& first = report.assets.front().device;
  const bool agree = std::all_of(report.assets.begin(), report.assets.end(), [&](const auto& asset) {
    return asset.device.name == first.name && asset.device.driver == first.driver &&
           asset.device.type == first.type;
  });
  return agree ? first : DeviceStamp();
}

ordered_json tool(const SceneReport& report) {
  const DeviceStamp device = device_of(report);
  return {{"version", report.tool_version},
          {"device", text_or_null(device.name)},
          {"driver", text_or_null(device.driver)},
          {"device_type", text_or_null(device.type)}};
}

ordered_json parameters(const SceneReport& report) {
  ordered_json metrics = ordered_json::array();
  ordered_json weights = ordered_json::object();
  for (std::size_t i = 0; i < kMetricCount; ++i) {
    if (report.options.metrics[i]) metrics.push_back(std::string(kMetricKeys[i]));
    weights[std::string(kMetricKeys[i])] = number(report.options.weights[i]);
  }
  return {{"alpha", number(report.parameters.alpha_degrees)},
          {"dim", report.parameters.dim},
          {"steps", report.parameters.steps},
          {"start_searches", report.parameters.start_searches},
          {"weld_tolerance", number(report.parameters.weld_tolerance)},
          {"metrics", std::move(metrics)},
          {"weights", std::move(weights)},
          {"relative", report.options.relative},
          {"eye", point(report.options.eye)}};
}

// Lengths are scaled like the row's area, which the square of the instance's scale takes to world units.
ordered_json signal(const std::optional<analysis::SignalSummary>& summary, double area_scale) {
  if (!summary) return nullptr;
  const bool starts = summary->length > 0;  // else no triangle has a neighbour
  return {{"length", summary->length},
          {"start_triangle", starts ? ordered_json(summary->start_triangle) : ordered_json()},
          {"mean_distance", starts ? number(summary->mean_distance * std::sqrt(area_scale)) : ordered_json()},
          {"gap", number(summary->gap)},
          {"searches", summary->searches}};
}

// Every kind, found or not. Places are triangles or vertices of the file's mesh.
ordered_json defects(const std::optional<analysis::Defects>& found) {
  if (!found) return nullptr;
  ordered_json counts = ordered_json::object();
  ordered_json places = ordered_json::object();
  for (std::size_t kind = 0; kind < analysis::kDefectCount; ++kind) {
    const auto defect = static_cast<analysis::Defect>(kind);
    const std::string key(analysis::kDefectKeys[kind]);
    const analysis::FoundDefect* one = found->find(defect);
    counts[key] = one == nullptr ? 0 : one->count;
    if (place_of(defect) == analysis::DefectPlace::kNone) continue;
    places[key] = one == nullptr ? ordered_json::array() : ordered_json(one->places);
  }
  return {{"counts", std::move(counts)}, {"places", std::move(places)}};
}

// Per draw; null where nothing was measured.
ordered_json rendering_time(const ratings::SceneRating& rating,
                            const std::optional<analysis::RenderingTime>& time) {
  if (!time || time->mean_ns <= 0 || !rating.timing) return nullptr;
  return {{"device", rating.timing->device.name},
          {"device_type", rating.timing->device.type},
          {"mean_ns", number(time->mean_ns)},
          {"confidence_ns", or_null(time->confidence_ns)},
          {"fastest_ns", number(time->fastest_ns)},
          {"slowest_ns", number(time->slowest_ns)},
          {"rounds", time->rounds},
          {"rotations", time->rotations},
          {"vertex_invocations", or_null(time->vertex_invocations)},
          {"fragment_invocations", or_null(time->fragment_invocations)},
          {"overdraw", or_null(time->overdraw)}};
}

// What all rendering times of the document were measured under.
ordered_json render_timing(const ratings::SceneRating& rating) {
  if (!rating.timing) return nullptr;
  return {{"device", rating.timing->device.name},
          {"driver", text_or_null(rating.timing->device.driver)},
          {"device_type", rating.timing->device.type},
          {"device_id", text_or_null(rating.timing->device.id)},
          {"width", rating.timing->width},
          {"height", rating.timing->height},
          {"steps", rating.timing->steps},
          {"timestamp_period_ns", number(rating.timestamp_period_ns)}};
}

ordered_json scene(const ratings::SceneRating& rating) {
  return {{"mesh_count", rating.meshes.size()},
          {"unique_triangles", rating.unique_triangles},
          {"drawn_triangles", rating.drawn_triangles},
          {"degenerate_triangles", rating.degenerate_triangles},
          {"bounds", box(rating.bounds)},
          {"eye", point(rating.eye)},
          {"density_mean", or_null(rating.density_mean)},
          {"density_deviation", or_null(rating.density_deviation)}};
}

ordered_json assets(const SceneReport& report) {
  ordered_json result = ordered_json::array();
  for (const analysis::AssetAnalysis& asset : report.assets)
    result.push_back({{"path", asset.asset},
                      {"format", asset.format},
                      {"unit_scale", or_null(asset.unit_scale)},
                      {"up_axis", or_null(asset.up_axis)},
                      {"warnings", asset.warnings}});
  return result;
}

}  // namespace

ordered_json document_head(const SceneReport& report) {
  return {{"schema_version", 1},
          {"tool", tool(report)},
          {"parameters", parameters(report)},
          {"render_timing", render_timing(report.rating)},
          {"scene", scene(report.rating)},
          {"assets", assets(report)}};
}

ordered_json mesh_row(const SceneReport& report, std::size_t index) {
  const ratings::MeshRating& mesh = report.rating.meshes.at(index);
  const analysis::AssetAnalysis& asset = report.assets[mesh.asset];
  const analysis::InstanceAnalysis& instance = asset.instances.at(mesh.instance);
  const analysis::GeometryAnalysis& geometry = asset.geometries.at(instance.geometry);
  const bool known = geometry.not_analysed.empty();  // counts of a mesh beyond a limit are unknown, not 0

  ordered_json row = ordered_json::object();
  row["index"] = index;
  row["asset"] = asset.asset;
  row["node"] = instance.node;
  row["mesh"] = instance.mesh;
  row["source_triangles"] = geometry.source_triangles;
  row["degenerate_triangles"] = known ? ordered_json(geometry.degenerate_triangles) : ordered_json();
  row["triangles"] = known ? ordered_json(geometry.triangles) : ordered_json();
  row["planar_groups"] = or_null(geometry.planar_groups);
  row["largest_planar_group"] = or_null(geometry.largest_planar_group);
  row["components"] = or_null(geometry.components);
  row["isolated_triangles"] = or_null(geometry.isolated_triangles);
  row["non_manifold_edges"] = or_null(geometry.non_manifold_edges);
  row["boundary_edges"] = or_null(geometry.boundary_edges);
  row["area_classes"] = or_null(geometry.area_classes);
  row["defects"] = defects(geometry.defects);
  row["signal"] = signal(geometry.signal, instance.area_scale);
  row["rendering_time"] = rendering_time(report.rating, mesh.rendering_time);
  row["surface_area"] = known ? number(mesh.surface_area) : ordered_json();
  row["density"] = or_null(mesh.density);
  row["bounds"] = box(instance.bounds);
  row["distance"] = or_null(mesh.distance);
  row["ratings"] = by_key(mesh.ratings);
  row["relative_ratings"] = by_key(mesh.relative_ratings);
  row["aggregate"] = or_null(mesh.aggregate);
  row["color"] = nullptr;
  if (mesh.aggregate)
    row["color"] = ratings::to_hex(
        ratings::color(*mesh.aggregate, ratings::ColorMap::kThesis, report.rating.signed_aggregate));
  row["not_analysed"] = text_or_null(geometry.not_analysed);
  row["no_fourier_transform"] = text_or_null(geometry.no_fourier_transform);
  row["no_rendering_time"] =
      text_or_null(mesh.rendering_time ? mesh.rendering_time->not_measured : std::string());
  return row;
}

std::string print(const ordered_json& value, int indent) {
  return value.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace scene_analyzer::report
