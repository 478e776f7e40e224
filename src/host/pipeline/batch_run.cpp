#include "pipeline/batch_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "gpu/error.h"
#include "pipeline/geometry_table.h"
#include "ratings/ratings.h"

namespace scene_analyzer::pipeline {
namespace {

using analysis::GeometryAnalysis;
using analysis::Metric;
using interface::mesh::GeometryTotals;

void fill_geometry(GeometryAnalysis& geometry, const GeometryTotals& totals) {
  geometry.triangles = totals.kept;
  geometry.degenerate_triangles = totals.degenerate;
  geometry.surface_area = totals.area;
}

void fill_topology(GeometryAnalysis& geometry, const interface::adjacency::TopologyTotals& totals) {
  geometry.components = totals.components;
  geometry.isolated_triangles = totals.isolated;
  geometry.boundary_edges = totals.boundary_edges;
  geometry.non_manifold_edges = totals.non_manifold_edges;
}

void fill_planar(GeometryAnalysis& geometry, const interface::planar_groups::PlanarTotals& totals,
                 analysis::MetricSet metrics) {
  geometry.planar_groups = totals.groups;
  geometry.largest_planar_group = totals.largest;
  if (geometry.triangles == 0) return;
  if (metrics.test(analysis::index_of(Metric::kPolygonsPerPlanarGroup)))
    geometry.polygons_per_planar_group =
        ratings::polygons_per_planar_group(geometry.triangles, totals.groups);
  if (metrics.test(analysis::index_of(Metric::kPlanarGroupVariation)))
    geometry.planar_group_variation =
        ratings::planar_group_variation(geometry.triangles, totals.squared_sizes);
}

void fill_contrast(GeometryAnalysis& geometry, double sum, std::uint64_t classes) {
  geometry.area_classes = classes;
  if (geometry.triangles == 0) return;
  const std::uint64_t with_neighbour = geometry.triangles - *geometry.isolated_triangles;
  // Rounding may carry the mean of values in [0,1] a last bit beyond.
  geometry.cooccurrence_contrast =
      with_neighbour == 0 ? 0 : std::min(1.0, sum / static_cast<double>(with_neighbour));
}

void fill_signal(GeometryAnalysis& geometry, const surface_distances::Signal& signal,
                 const spectrum::SpectrumTotals& spectrum) {
  geometry.signal = analysis::SignalSummary{.length = signal.areas.size(),
                                            .start_triangle = signal.start_triangle,
                                            .mean_distance = signal.mean_distance,
                                            .gap = signal.gap,
                                            .searches = signal.searches};
  geometry.fourier_transform = ratings::fourier_transform(spectrum.zero, spectrum.largest, spectrum.sum,
                                                          spectrum.weighted_sum, signal.areas.size());
}

}  // namespace

void BatchRun::run_on_device() {
  step_(0, "areas and adjacency");
  measure_geometry();
  if (wants(Metric::kFourierTransform)) search_signals();
  if (wants(Metric::kPolygonsPerPlanarGroup) || wants(Metric::kPlanarGroupVariation)) {
    step_(0.1, "planar groups");
    find_planar_groups();
  }
  step_(0.2, "bounds");
  bound_instances();
  if (wants(Metric::kCooccurrenceContrast) || histograms_) {
    step_(0.2, "co-occurrence");
    compare_areas();
  }
  geometry_ = {};
  adjacency_ = {};
}

void BatchRun::finish() {
  if (search_.started()) {
    step_(0.3, "start triangles");
    const auto signals =
        search_.finish([&](double fraction) { step_(0.3 + 0.6 * fraction, "start triangles"); });
    step_(0.9, "spectra");
    transform_signals(signals);
  }
  step_(1, "results");
}

void BatchRun::search_signals() {
  search_.start(stages_.arcs.measure(stages_.device, geometry_, adjacency_), plan_,
                parameters_.start_searches);
}

void BatchRun::transform_signals(const std::vector<surface_distances::Signal>& signals) {
  std::vector<std::span<const double>> samples;
  for (const surface_distances::Signal& signal : signals) samples.emplace_back(signal.areas);
  std::vector<std::vector<double>> magnitudes(signals.size());
  spectrum::MagnitudeSink keep;
  if (signals_)
    keep = [&](std::size_t mesh, std::span<const double> values) {
      magnitudes[mesh].assign(values.begin(), values.end());
    };
  const auto spectra = transform_all(samples, keep);
  for (std::size_t mesh = 0; mesh < signals.size(); ++mesh) {
    if (totals_[mesh].kept == 0 || !target(mesh).no_fourier_transform.empty()) continue;
    fill_signal(target(mesh), signals[mesh], spectra[mesh]);
    if (signals_) signals_(plan_.geometries[mesh], {.areas = samples[mesh], .magnitudes = magnitudes[mesh]});
  }
}

std::vector<spectrum::SpectrumTotals> BatchRun::transform_all(
    const std::vector<std::span<const double>>& samples, const spectrum::MagnitudeSink& keep) {
  try {
    return stages_.spectra.transform(samples, keep);
  } catch (const gpu::OutOfMemory&) {
    // One is too much: each by itself, so that neither the others' spectra nor other ratings are lost.
  }
  std::vector<spectrum::SpectrumTotals> spectra(samples.size());
  for (std::size_t mesh = 0; mesh < samples.size(); ++mesh) {
    const auto keep_one = [&](std::size_t, std::span<const double> values) { keep(mesh, values); };
    try {
      spectra[mesh] = stages_.spectra
                          .transform(std::span(samples).subspan(mesh, 1),
                                     keep ? spectrum::MagnitudeSink(keep_one) : spectrum::MagnitudeSink())
                          .front();
    } catch (const gpu::OutOfMemory& error) {
      target(mesh).no_fourier_transform = error.what();
    }
  }
  return spectra;
}

void BatchRun::measure_geometry() {
  gpu::Recorder recorder(stages_.device);
  geometry_ = stages_.geometry.record(recorder, plan_.batch, parameters_.weld_tolerance);
  auto matching = stages_.adjacency.record_matching(recorder, geometry_);
  recorder.submit_and_wait();
  adjacency_ = stages_.adjacency.complete(stages_.device, geometry_, std::move(matching));
  totals_ = geometry_.results(stages_.device);
  const auto topology = geometry_.chunks.results(stages_.device, adjacency_.totals);
  for (std::size_t mesh = 0; mesh < totals_.size(); ++mesh) {
    fill_geometry(target(mesh), totals_[mesh]);
    fill_topology(target(mesh), topology[mesh]);
  }
  find_defects();
  if (degenerate_) list_degenerate();
  adjacency_.labels = {};  // components are counted: free them for the stages to come
}

void BatchRun::find_defects() {
  gpu::Recorder recorder(stages_.device);
  const auto chunks = stages_.defects.record(recorder, geometry_, adjacency_);
  recorder.submit_and_wait();
  std::vector<analysis::Defects> defects = defects::read_defects(stages_.device, geometry_, chunks);
  for (std::size_t mesh = 0; mesh < defects.size(); ++mesh) target(mesh).defects = std::move(defects[mesh]);
  geometry_.representative = {};  // nobody else looks at vertices one by one
  geometry_.referenced = {};
}

void BatchRun::list_degenerate() {
  for (std::size_t mesh = 0; mesh < totals_.size(); ++mesh) {
    if (totals_[mesh].degenerate == 0) continue;
    const auto& record = geometry_.records[mesh];
    const std::vector<double> areas =
        geometry_.areas.download(stages_.device, record.first_triangle, record.triangle_count);
    std::vector<std::uint32_t> degenerate;
    for (std::uint32_t triangle = 0; triangle < areas.size(); ++triangle)
      if (areas[triangle] == 0) degenerate.push_back(triangle);
    degenerate_(plan_.geometries[mesh], std::move(degenerate));
  }
}

void BatchRun::find_planar_groups() {
  gpu::Recorder recorder(stages_.device);
  const auto groups = stages_.planar.record(recorder, geometry_, adjacency_, parameters_.alpha_degrees);
  recorder.submit_and_wait();
  const auto totals = geometry_.chunks.results(stages_.device, groups.totals);
  for (std::size_t mesh = 0; mesh < totals.size(); ++mesh) fill_planar(target(mesh), totals[mesh], metrics_);
  if (group_sizes_) list_group_sizes(groups);
}

void BatchRun::list_group_sizes(const planar_groups::PlanarGroups& groups) {
  for (std::size_t mesh = 0; mesh < totals_.size(); ++mesh) {
    if (totals_[mesh].kept == 0) continue;
    const auto& record = geometry_.records[mesh];
    const auto of_mesh = [&](const auto& array) {
      return array.download(stages_.device, record.first_triangle, record.triangle_count);
    };
    const std::vector<std::uint32_t> labels = of_mesh(groups.labels), sizes_at_lowest = of_mesh(groups.sizes);
    const std::vector<double> areas = of_mesh(geometry_.areas);
    std::vector<std::uint32_t> sizes(labels.size());
    for (std::size_t triangle = 0; triangle < sizes.size(); ++triangle)
      if (areas[triangle] > 0) sizes[triangle] = sizes_at_lowest[labels[triangle] - record.first_triangle];
    group_sizes_(plan_.geometries[mesh], std::move(sizes));
  }
}

void BatchRun::bound_instances() {
  std::vector<std::uint32_t> mesh_of_geometry(analysis_.geometries.size(), interface::mesh::kNone);
  for (std::uint32_t mesh = 0; mesh < plan_.geometries.size(); ++mesh)
    mesh_of_geometry[plan_.geometries[mesh]] = mesh;
  std::vector<geometry::InstanceToBound> to_bound;
  std::vector<analysis::InstanceAnalysis*> targets;
  for (analysis::InstanceAnalysis& instance : analysis_.instances) {
    const std::uint32_t mesh = mesh_of_geometry[instance.geometry];
    if (mesh == interface::mesh::kNone || totals_[mesh].kept == 0) continue;
    if (!std::all_of(instance.world.begin(), instance.world.end(),
                     [](double entry) { return std::isfinite(entry); }))
      continue;  // nowhere: bounds stay absent
    const GeometryTotals& totals = totals_[mesh];
    analysis::Bounds local;
    std::copy(totals.low.begin(), totals.low.end(), local.min.begin());
    std::copy(totals.high.begin(), totals.high.end(), local.max.begin());
    instance.bounds = carry_bounds(local, instance.world);
    if (instance.bounds) continue;
    to_bound.push_back({.mesh = mesh, .world = instance.world});
    targets.push_back(&instance);
  }
  const auto bounds = stages_.geometry.bound_instances(stages_.device, geometry_, to_bound);
  for (std::size_t i = 0; i < targets.size(); ++i)
    targets[i]->bounds = analysis::Bounds{.min = {bounds[i][0], bounds[i][2], bounds[i][4]},
                                          .max = {bounds[i][1], bounds[i][3], bounds[i][5]}};
}

void BatchRun::compare_areas() {
  const bool contrast = wants(Metric::kCooccurrenceContrast);
  const auto kept = [](const GeometryTotals& totals) { return totals.kept > 0; };
  if (std::none_of(totals_.begin(), totals_.end(), kept)) {
    for (std::size_t mesh = 0; contrast && mesh < totals_.size(); ++mesh) fill_contrast(target(mesh), 0, 0);
    return;
  }
  cooccurrence::AreaClasses classes;
  {
    gpu::Recorder recorder(stages_.device);
    classes = stages_.classes.record(recorder, geometry_, totals_);
    recorder.submit_and_wait();
  }
  stages_.classes.limit(stages_.device, classes, parameters_.dim);
  if (contrast) sum_contrast(classes);
  if (histograms_) count_histograms(classes);
}

void BatchRun::sum_contrast(const cooccurrence::AreaClasses& classes) {
  gpu::Recorder recorder(stages_.device);
  const auto partial = stages_.contrast.record(recorder, geometry_, adjacency_, classes);
  recorder.submit_and_wait();
  const auto sums = geometry_.chunks.results(stages_.device, partial);
  for (std::size_t mesh = 0; mesh < sums.size(); ++mesh)
    fill_contrast(target(mesh), sums[mesh], classes.counts[mesh]);
}

void BatchRun::count_histograms(const cooccurrence::AreaClasses& classes) {
  if (!stages_.histograms) stages_.histograms.emplace(stages_.device, stages_.scan, stages_.sort);
  const auto hand_over = [&](std::size_t mesh, const analysis::Histogram& histogram) {
    if (totals_[mesh].kept > 0) histograms_(plan_.geometries[mesh], histogram);
  };
  try {
    stages_.histograms->build(stages_.device, geometry_, adjacency_, classes, hand_over);
  } catch (const gpu::OutOfMemory& error) {
    if (plan_.geometries.size() > 1) throw;  // each mesh will have the device for itself
    // The ratings are there: no reason to lose them.
    analysis::Histogram missing;
    missing.refused = error.what();
    hand_over(0, missing);
  }
}

}  // namespace scene_analyzer::pipeline
