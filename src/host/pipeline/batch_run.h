// batch_run.h — One batch of meshes on its way through the stages.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/batching.h"
#include "pipeline/signal_search.h"
#include "pipeline/stages.h"

namespace scene_analyzer::pipeline {

class BatchRun {
 public:
  // Part of the batch that is done in [0,1], and what comes next.
  using Step = std::function<void(double fraction, const char* what)>;

  // `measurement` must outlive the run.
  BatchRun(Measurer::Stages& stages, PlannedBatch plan, const Measurement& measurement, Step step)
      : stages_(stages),
        plan_(std::move(plan)),
        parameters_(measurement.parameters),
        metrics_(measurement.metrics),
        analysis_(measurement.analysis),
        histograms_(measurement.histograms),
        signals_(measurement.signals),
        degenerate_(measurement.degenerate),
        group_sizes_(measurement.group_sizes),
        step_(std::move(step)) {}

  // All stages that run on the device but the spectra, after which the batch holds none of its memory. Start
  // triangles are searched for on the host meanwhile, and on when this returns. Throws gpu::OutOfMemory.
  void run_on_device();
  bool is_searching() const { return search_.is_running(); }
  // Waits for the search; spectra.
  void finish();

  const PlannedBatch& plan() const { return plan_; }

 private:
  analysis::GeometryAnalysis& target(std::size_t mesh) {
    return analysis_.geometries[plan_.geometries[mesh]];
  }
  bool wants(analysis::Metric metric) const { return metrics_.test(analysis::index_of(metric)); }

  void measure_geometry();
  void find_defects();
  void list_degenerate();
  void search_signals();
  void find_planar_groups();
  void list_group_sizes(const planar_groups::PlanarGroups& groups);
  void bound_instances();
  void compare_areas();
  void sum_contrast(const cooccurrence::AreaClasses& classes);
  void count_histograms(const cooccurrence::AreaClasses& classes);
  void transform_signals(const std::vector<surface_distances::Signal>& signals);
  std::vector<spectrum::SpectrumTotals> transform_all(const std::vector<std::span<const double>>& samples,
                                                      const spectrum::MagnitudeSink& keep);

  Measurer::Stages& stages_;
  const PlannedBatch plan_;
  const analysis::Parameters& parameters_;
  analysis::MetricSet metrics_;
  analysis::AssetAnalysis& analysis_;
  const HistogramSink& histograms_;
  const SignalSink& signals_;
  const DegenerateSink& degenerate_;
  const GroupSizeSink& group_sizes_;
  const Step step_;
  geometry::Geometry geometry_;
  adjacency::Adjacency adjacency_;
  std::vector<interface::mesh::GeometryTotals> totals_;
  SignalSearch search_;  // last: it reads the plan until it has ended
};

}  // namespace scene_analyzer::pipeline
