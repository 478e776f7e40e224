#include "pipeline/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "adjacency/adjacency.h"
#include "cooccurrence/area_classes.h"
#include "cooccurrence/contrast.h"
#include "cooccurrence/histogram.h"
#include "geometry/geometry.h"
#include "gpu/error.h"
#include "pipeline/batching.h"
#include "pipeline/geometry_table.h"
#include "planar_groups/planar_groups.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"
#include "ratings/ratings.h"

namespace scene_analyzer::pipeline {
namespace {

using analysis::GeometryAnalysis;
using analysis::Metric;
using interface::mesh::GeometryTotals;

bool wants(analysis::MetricSet metrics, Metric metric) {
  return metrics.test(analysis::index_of(metric));
}

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
  if (wants(metrics, Metric::kPolygonsPerPlanarGroup))
    geometry.polygons_per_planar_group =
        ratings::polygons_per_planar_group(geometry.triangles, totals.groups);
  if (wants(metrics, Metric::kPlanarGroupVariation))
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

}  // namespace

struct Measurer::Stages {
  gpu::Device& device;
  primitives::Scan scan{device};
  primitives::RadixSort sort{device, scan};
  geometry::GeometryBuilder geometry{device};
  adjacency::AdjacencyBuilder adjacency{device, sort};
  planar_groups::PlanarGroupBuilder planar{device, scan, sort};
  cooccurrence::AreaClassBuilder classes{device, scan, sort};
  cooccurrence::ContrastSummer contrast{device, scan};
  std::optional<cooccurrence::HistogramBuilder> histograms;  // made when somebody asks

  explicit Stages(gpu::Device& on) : device(on) {}
};

namespace {

// One batch on its way through the stages.
class BatchRun {
 public:
  BatchRun(Measurer::Stages& stages, const PlannedBatch& plan, const analysis::Parameters& parameters,
           analysis::MetricSet metrics, analysis::AssetAnalysis& analysis, const HistogramSink& histograms)
      : stages_(stages),
        plan_(plan),
        parameters_(parameters),
        metrics_(metrics),
        analysis_(analysis),
        histograms_(histograms) {}

  void run(const std::function<void(const char*)>& step) {
    step("areas and adjacency");
    measure_geometry();
    if (wants(metrics_, Metric::kPolygonsPerPlanarGroup) || wants(metrics_, Metric::kPlanarGroupVariation)) {
      step("planar groups");
      find_planar_groups();
    }
    step("bounds");
    bound_instances();
    if (wants(metrics_, Metric::kCooccurrenceContrast) || histograms_) {
      step("co-occurrence");
      compare_areas();
    }
  }

 private:
  GeometryAnalysis& target(std::size_t mesh) { return analysis_.geometries[plan_.geometries[mesh]]; }

  void measure_geometry() {
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
    adjacency_.labels = {};  // components are counted: free them for the stages to come
  }

  void find_planar_groups() {
    gpu::Recorder recorder(stages_.device);
    const auto groups = stages_.planar.record(recorder, geometry_, adjacency_, parameters_.alpha_degrees);
    recorder.submit_and_wait();
    const auto totals = geometry_.chunks.results(stages_.device, groups.totals);
    for (std::size_t mesh = 0; mesh < totals.size(); ++mesh)
      fill_planar(target(mesh), totals[mesh], metrics_);
  }

  void bound_instances() {
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

  void compare_areas() {
    const bool contrast = wants(metrics_, Metric::kCooccurrenceContrast);
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

  void sum_contrast(const cooccurrence::AreaClasses& classes) {
    gpu::Recorder recorder(stages_.device);
    const auto partial = stages_.contrast.record(recorder, geometry_, adjacency_, classes);
    recorder.submit_and_wait();
    const auto sums = geometry_.chunks.results(stages_.device, partial);
    for (std::size_t mesh = 0; mesh < sums.size(); ++mesh)
      fill_contrast(target(mesh), sums[mesh], classes.counts[mesh]);
  }

  void count_histograms(const cooccurrence::AreaClasses& classes) {
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

  Measurer::Stages& stages_;
  const PlannedBatch& plan_;
  const analysis::Parameters& parameters_;
  analysis::MetricSet metrics_;
  analysis::AssetAnalysis& analysis_;
  const HistogramSink& histograms_;
  geometry::Geometry geometry_;
  adjacency::Adjacency adjacency_;
  std::vector<GeometryTotals> totals_;
};

}  // namespace

Measurer::Measurer(gpu::Device& device) : stages_(std::make_unique<Stages>(device)) {}
Measurer::~Measurer() = default;

void Measurer::measure_batch(const PlannedBatch& plan, const analysis::Parameters& parameters,
                             analysis::MetricSet metrics, const std::function<void(const char*)>& step,
                             analysis::AssetAnalysis& analysis, const HistogramSink& histograms) {
  try {
    BatchRun(*stages_, plan, parameters, metrics, analysis, histograms).run(step);
  } catch (const gpu::OutOfMemory& error) {
    // The estimate was too low: meshes with many shared edges need more. Halves get the device for
    // themselves, down to single meshes; one that still does not fit is reported, and the others keep their
    // results.
    if (plan.geometries.size() == 1) {
      GeometryAnalysis& geometry = analysis.geometries[plan.geometries.front()];
      GeometryAnalysis untouched;
      untouched.mesh = geometry.mesh;
      untouched.linear = geometry.linear;
      untouched.source_triangles = geometry.source_triangles;
      untouched.not_analysed = error.what();
      geometry = std::move(untouched);
      for (analysis::InstanceAnalysis& instance : analysis.instances)
        if (instance.geometry == plan.geometries.front()) instance.bounds = std::nullopt;
      return;
    }
    const auto middle = static_cast<std::ptrdiff_t>(plan.geometries.size() / 2);
    const auto& meshes = plan.batch.meshes;
    const auto& geometries = plan.geometries;
    const PlannedBatch halves[] = {
        {.batch = {.meshes = {meshes.begin(), meshes.begin() + middle},
                   .transformed = plan.batch.transformed},
         .geometries = {geometries.begin(), geometries.begin() + middle}},
        {.batch = {.meshes = {meshes.begin() + middle, meshes.end()}, .transformed = plan.batch.transformed},
         .geometries = {geometries.begin() + middle, geometries.end()}}};
    for (const PlannedBatch& half : halves)
      measure_batch(half, parameters, metrics, step, analysis, histograms);
  }
}

void Measurer::measure(const mesh::Scene& scene, const analysis::Parameters& parameters,
                       analysis::MetricSet metrics, const Progress& progress,
                       analysis::AssetAnalysis& analysis, const HistogramSink& histograms,
                       const SignalSink&) {
  GeometryTable table = make_geometry_table(scene);
  analysis.geometries = std::move(table.geometries);
  analysis.instances = std::move(table.instances);
  const auto batches = plan_batches(scene, stages_->device.info(), analysis.geometries);
  std::uint64_t all = 0, done = 0;
  for (const PlannedBatch& plan : batches) all += plan.batch.triangle_count();
  for (const PlannedBatch& plan : batches) {
    const std::uint64_t here = plan.batch.triangle_count();
    unsigned steps = 0;
    const auto report = [&](const char* step) {
      constexpr double kSteps = 4;
      const double within = std::min(steps++, 3U) / kSteps * static_cast<double>(here);
      if (progress) progress((static_cast<double>(done) + within) / static_cast<double>(all), step);
    };
    measure_batch(plan, parameters, metrics, report, analysis, histograms);
    done += here;
  }
}

}  // namespace scene_analyzer::pipeline
