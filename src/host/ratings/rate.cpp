// rate.cpp — The scene's recipe: facts per mesh, statistics of the scene, ratings, aggregates. Every loop is
// over meshes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

using analysis::AssetAnalysis;
using analysis::Bounds;
using analysis::GeometryAnalysis;
using analysis::index_of;
using analysis::InstanceAnalysis;
using analysis::Metric;

const GeometryAnalysis& geometry_of(std::span<const AssetAnalysis> assets, const MeshRating& mesh) {
  const AssetAnalysis& asset = assets[mesh.asset];
  return asset.geometries.at(asset.instances[mesh.instance].geometry);
}

// Meshes without triangles, and those a device could not take, are part of no rating and of no statistic.
bool is_rated(const GeometryAnalysis& geometry) {
  return geometry.not_analysed.empty() && geometry.triangles > 0;
}

bool is_finite(const Bounds& bounds) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(bounds.min.begin(), bounds.min.end(), finite) &&
         std::all_of(bounds.max.begin(), bounds.max.end(), finite);
}

std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

void grow(std::optional<Bounds>& scene, const Bounds& mesh) {
  if (!scene) {
    scene = mesh;
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scene->min[axis] = std::min(scene->min[axis], mesh.min[axis]);
    scene->max[axis] = std::max(scene->max[axis], mesh.max[axis]);
  }
}

// A mesh that was also measured under a node that shears it is one mesh of the file; shearing can only
// flatten more of its triangles, so the largest count is the one to tell.
std::uint64_t unique_triangles(const AssetAnalysis& asset) {
  std::unordered_map<std::uint32_t, std::uint64_t> per_mesh;
  std::uint64_t total = 0;
  for (const GeometryAnalysis& geometry : asset.geometries) {
    std::uint64_t& counted = per_mesh[geometry.mesh];
    if (geometry.triangles <= counted) continue;
    total += geometry.triangles - counted;
    counted = geometry.triangles;
  }
  return total;
}

MeshRating facts(const InstanceAnalysis& instance, const GeometryAnalysis& geometry) {
  MeshRating mesh;
  const double area = geometry.surface_area * instance.area_scale;
  mesh.surface_area = area;
  if (!is_rated(geometry)) return mesh;
  const double density = static_cast<double>(geometry.triangles) / area;
  if (std::isfinite(density) && density > 0) mesh.density = density;
  return mesh;
}

SceneRating gather(std::span<const AssetAnalysis> assets) {
  SceneRating scene;
  for (std::size_t a = 0; a < assets.size(); ++a) {
    scene.unique_triangles += unique_triangles(assets[a]);
    for (std::size_t i = 0; i < assets[a].instances.size(); ++i) {
      const InstanceAnalysis& instance = assets[a].instances[i];
      const GeometryAnalysis& geometry = assets[a].geometries.at(instance.geometry);
      MeshRating mesh = facts(instance, geometry);
      mesh.asset = a;
      mesh.instance = i;
      scene.meshes.push_back(mesh);
      scene.drawn_triangles += geometry.triangles;
      scene.degenerate_triangles += geometry.degenerate_triangles;
      if (is_rated(geometry) && instance.bounds && is_finite(*instance.bounds))
        grow(scene.bounds, *instance.bounds);
    }
  }
  return scene;
}

void measure_distances(std::span<const AssetAnalysis> assets, const std::optional<mesh::Vector3>& given_eye,
                       SceneRating& scene) {
  if (!scene.bounds) return;
  scene.eye = given_eye ? *given_eye : default_eye(*scene.bounds);
  for (MeshRating& mesh : scene.meshes) {
    const InstanceAnalysis& instance = assets[mesh.asset].instances[mesh.instance];
    if (!is_rated(geometry_of(assets, mesh)) || !instance.bounds || !is_finite(*instance.bounds)) continue;
    const double distance = distance_to(*instance.bounds, *scene.eye);
    if (std::isfinite(distance)) mesh.distance = distance;
  }
}

const analysis::RenderTiming* timing_under(const AssetAnalysis& asset,
                                           const analysis::RenderTiming::Conditions& conditions) {
  const auto found = std::ranges::find(asset.timings, conditions, &analysis::RenderTiming::conditions);
  return found == asset.timings.end() ? nullptr : &*found;
}

bool has_something_to_time(const AssetAnalysis& asset) {
  return std::ranges::any_of(asset.geometries, is_rated);
}

// The first conditions that all assets with a mesh were measured under, in the order of the first of them.
void choose_timing(std::span<const AssetAnalysis> assets, SceneRating& scene) {
  std::vector<const AssetAnalysis*> timed;
  for (const AssetAnalysis& asset : assets)
    if (has_something_to_time(asset) && !asset.timings.empty()) timed.push_back(&asset);
  if (timed.empty()) return;
  for (const analysis::RenderTiming& timing : timed.front()->timings) {
    const auto has_it = [&](const AssetAnalysis* asset) {
      return timing_under(*asset, timing.conditions) != nullptr;
    };
    if (!std::ranges::all_of(timed, has_it)) continue;
    scene.timing = timing.conditions;
    scene.timestamp_period_ns = timing.timestamp_period_ns;
    return;
  }
  scene.mixed_timings = true;
}

void take_rendering_times(std::span<const AssetAnalysis> assets, SceneRating& scene) {
  choose_timing(assets, scene);
  if (!scene.timing) return;
  for (MeshRating& mesh : scene.meshes) {
    const analysis::RenderTiming* timing = timing_under(assets[mesh.asset], *scene.timing);
    if (timing == nullptr || !is_rated(geometry_of(assets, mesh))) continue;
    mesh.rendering_time = timing->times.at(assets[mesh.asset].instances[mesh.instance].geometry);
  }
}

std::optional<double> nanoseconds(const MeshRating& mesh) {
  if (!mesh.rendering_time || mesh.rendering_time->mean_ns <= 0) return std::nullopt;
  return mesh.rendering_time->mean_ns;
}

// Rates those meshes that have the fact, against each other; `rows` runs along scene.meshes.
template <typename Fact>
void rate_against_each_other(const SceneRating& scene, Fact fact, Metric metric,
                             std::vector<double> (*rule)(std::span<const double>),
                             std::vector<OptionalRatings>& rows) {
  std::vector<double> values;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const std::optional<double> value = std::invoke(fact, scene.meshes[i]);
    if (!value) continue;
    values.push_back(*value);
    owners.push_back(i);
  }
  const std::vector<double> rated = rule(values);
  for (std::size_t k = 0; k < owners.size(); ++k) rows[owners[k]][index_of(metric)] = rated[k];
}

OptionalRatings mesh_ratings(const GeometryAnalysis& geometry) {
  OptionalRatings row;
  if (!is_rated(geometry)) return row;
  row[index_of(Metric::kPolygonsPerPlanarGroup)] = finite(geometry.polygons_per_planar_group);
  row[index_of(Metric::kPlanarGroupVariation)] = finite(geometry.planar_group_variation);
  row[index_of(Metric::kCooccurrenceContrast)] = finite(geometry.cooccurrence_contrast);
  row[index_of(Metric::kFourierTransform)] = finite(geometry.fourier_transform);
  return row;
}

void summarise_densities(SceneRating& scene) {
  std::vector<double> densities;
  for (const MeshRating& mesh : scene.meshes)
    if (mesh.density) densities.push_back(*mesh.density);
  if (densities.empty()) return;
  const DensityStatistics statistics = density_statistics(densities);
  scene.density_mean = statistics.mean;
  scene.density_deviation = statistics.deviation;
}

}  // namespace

SceneRating rate(std::span<const AssetAnalysis> assets, const Options& options) {
  SceneRating scene = gather(assets);
  measure_distances(assets, options.eye, scene);
  summarise_densities(scene);
  take_rendering_times(assets, scene);

  std::vector<OptionalRatings> rows;
  rows.reserve(scene.meshes.size());
  for (const MeshRating& mesh : scene.meshes) rows.push_back(mesh_ratings(geometry_of(assets, mesh)));
  rate_against_each_other(scene, &MeshRating::density, Metric::kRelativeDensity, relative_densities, rows);
  rate_against_each_other(scene, &MeshRating::distance, Metric::kDistance, distance_ratings, rows);
  rate_against_each_other(scene, nanoseconds, Metric::kRenderingTime, rendering_time_ratings, rows);
  for (OptionalRatings& row : rows)
    for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
      if (!options.metrics[i]) row[i] = std::nullopt;

  const std::vector<OptionalRatings> mapped = relative_ratings(rows);
  const std::vector<std::optional<double>> combined = aggregates(rows, options);
  scene.signed_aggregate = density_stands_alone(rows, options.weights);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    scene.meshes[i].ratings = rows[i];
    scene.meshes[i].relative_ratings = mapped[i];
    scene.meshes[i].aggregate = combined[i];
  }
  return scene;
}

}  // namespace scene_analyzer::ratings
