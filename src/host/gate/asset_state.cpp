#include "gate/asset_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scene_analyzer::gate {
namespace {

namespace fs = std::filesystem;
using analysis::GeometryAnalysis;
using analysis::Metric;

Value missing(std::string why_not) {
  return {std::nullopt, std::move(why_not)};
}

Value file_bytes(const analysis::AssetAnalysis& asset) {
  double bytes = 0;
  for (const analysis::FileFingerprint& file : asset.files) {
    if (!file.found) return missing(fmt::format("a file that it refers to is missing: {}", file.path));
    bytes += static_cast<double>(file.size);
  }
  if (asset.files.empty()) return missing("the sizes of its files are not known");
  return {bytes, {}};
}

Value asset_triangles(const analysis::AssetAnalysis& asset) {
  double triangles = 0;
  for (const analysis::InstanceAnalysis& instance : asset.instances) {
    const GeometryAnalysis& geometry = asset.geometries.at(instance.geometry);
    if (!geometry.not_analysed.empty())
      return missing(fmt::format("a mesh could not be analysed: {}", geometry.not_analysed));
    triangles += static_cast<double>(geometry.triangles);
  }
  return {triangles, {}};
}

Value defects(const GeometryAnalysis& geometry, Quantity quantity) {
  if (!geometry.defects)
    return geometry.source_triangles == 0 ? missing("it has no triangles")
                                          : missing("its defects were not counted");
  if (const auto kind = counted_defect(quantity))
    return {static_cast<double>(geometry.defects->count(*kind)), {}};
  double total = 0;
  for (const analysis::FoundDefect& one : geometry.defects->found) total += static_cast<double>(one.count);
  return {total, {}};
}

Value rendering_time(const ratings::SceneRating& rating, const ratings::MeshRating& mesh) {
  constexpr double kNanosecondsPerMillisecond = 1e6;
  if (rating.mixed_timings) return missing("its rendering times are of several devices");
  if (!mesh.rendering_time) return missing("its rendering time was not measured");
  if (mesh.rendering_time->mean_ns > 0)
    return {mesh.rendering_time->mean_ns / kNanosecondsPerMillisecond, {}};
  return missing(mesh.rendering_time->not_measured.empty() ? "its rendering time was not measured"
                                                           : mesh.rendering_time->not_measured);
}

std::string why_no_rating(const AssetState& asset, std::size_t mesh, const GeometryAnalysis& geometry,
                          Quantity quantity) {
  const auto metric = rated_metric(quantity);
  if (!metric) return "it has none of the ratings that the aggregate is made of";
  switch (*metric) {
    case Metric::kFourierTransform:
      if (!geometry.no_fourier_transform.empty()) return geometry.no_fourier_transform;
      break;
    case Metric::kRenderingTime:
      return rendering_time(asset.rating, asset.rating.meshes[mesh]).why_not;
    case Metric::kRelativeDensity:
      return "its density is no finite number above 0: its place or its scale is out of range";
    case Metric::kDistance:
      return "its distance is no finite number: its place is out of range";
    default:
      break;
  }
  return fmt::format("it has no {}", info(quantity).key);
}

Value rating(const AssetState& asset, std::size_t mesh, const GeometryAnalysis& geometry, Quantity quantity) {
  const ratings::MeshRating& rated = asset.rating.meshes[mesh];
  const auto metric = rated_metric(quantity);
  const std::optional<double> number = metric ? rated.ratings[index_of(*metric)] : rated.aggregate;
  if (number && std::isfinite(*number)) return {number, {}};
  return missing(why_no_rating(asset, mesh, geometry, quantity));
}

}  // namespace

AssetState state_of(std::string path, analysis::AssetAnalysis analysis, analysis::MetricSet metrics,
                    const Weights& weights, const std::optional<mesh::Vector3>& eye) {
  AssetState state;
  state.path = std::move(path);
  state.analysis = std::move(analysis);
  ratings::Options options;
  options.metrics = metrics;
  options.weights = weights;
  options.eye = eye;
  state.rating = ratings::rate(std::span(&*state.analysis, 1), options);
  return state;
}

std::string portable_path(const fs::path& asset, const fs::path& working_folder) {
  const fs::path normal = asset.lexically_normal();
  if (normal.is_relative()) return normal.generic_string();
  const fs::path relative = normal.lexically_relative(working_folder.lexically_normal());
  return (relative.empty() ? normal.relative_path() : relative).generic_string();
}

const analysis::InstanceAnalysis& instance_of(const AssetState& asset, std::size_t mesh) {
  return asset.analysis->instances.at(asset.rating.meshes.at(mesh).instance);
}

const GeometryAnalysis& geometry_of(const AssetState& asset, std::size_t mesh) {
  return asset.analysis->geometries.at(instance_of(asset, mesh).geometry);
}

Value asset_value(const AssetState& asset, Quantity quantity) {
  return quantity == Quantity::kFileBytes ? file_bytes(*asset.analysis) : asset_triangles(*asset.analysis);
}

Value mesh_value(const AssetState& asset, std::size_t mesh, Quantity quantity) {
  const GeometryAnalysis& geometry = geometry_of(asset, mesh);
  if (!geometry.not_analysed.empty()) return missing(geometry.not_analysed);
  if (quantity >= Quantity::kFirstDefect) return defects(geometry, quantity);
  if (quantity == Quantity::kTriangles) return {static_cast<double>(geometry.triangles), {}};
  if (geometry.triangles == 0) return missing("it has no triangle with an area");
  if (quantity == Quantity::kRenderingTime) return rendering_time(asset.rating, asset.rating.meshes[mesh]);
  return rating(asset, mesh, geometry, quantity);
}

}  // namespace scene_analyzer::gate
