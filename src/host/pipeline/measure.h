// measure.h — The GPU recipe: scene -> analyses, every stage over whole batches of meshes.
//
// Geometries are deduplicated first (instances under similarity transforms share one), cut into batches by
// the device's memory and buffer limits, and each batch runs through welding, areas, adjacency, planar
// groups, area classes and co-occurrence, while the host searches start triangles for the signals whose
// spectra come last. The device does not wait for that search: the next batch is measured meanwhile, and the
// next scene may be.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "analysis/analysis.h"
#include "analysis/histogram.h"
#include "analysis/signal.h"
#include "gpu/device.h"
#include "mesh/scene.h"
#include "spectrum/spectrum.h"

namespace scene_analyzer::pipeline {

class PendingMeasurement;

// Called between steps: fraction done of the current asset in [0,1], never falling, and what is being done
// ("planar groups").
using Progress = std::function<void(double fraction, const std::string& step)>;

// Takes the co-occurrence histogram of one geometry with a kept triangle, counts and bounds of which are
// already in the analysis. May be called again for a geometry whose batch ran out of memory: the last counts.
using HistogramSink = std::function<void(std::uint32_t geometry, const analysis::Histogram& histogram)>;

// Takes the signal of one geometry whose `signal` summary is already in the analysis. May be called again, as
// above.
using SignalSink = std::function<void(std::uint32_t geometry, const analysis::SignalSpectrum& signal)>;

// Takes the degenerate triangles of one geometry that has some: indices in its mesh, ascending.
using DegenerateSink = std::function<void(std::uint32_t geometry, std::vector<std::uint32_t> triangles)>;

// Takes for every triangle of one geometry the number of triangles in its planar group, 0 for degenerate
// ones. Asked for with a metric of planar groups. May be called again, as above.
using GroupSizeSink = std::function<void(std::uint32_t geometry, std::vector<std::uint32_t> sizes)>;

// What a measurement reads, and where its results go.
struct Measurement {
  const mesh::Scene& scene;           // must outlive the measurement,
  analysis::AssetAnalysis& analysis;  // as must this: its `geometries` and `instances` are filled
  analysis::Parameters parameters = {};
  analysis::MetricSet metrics = analysis::MetricSet().set();  // counts, areas and bounds always
  Progress progress = {};
  HistogramSink histograms = {};  // without one there are none
  SignalSink signals = {};
  DegenerateSink degenerate = {};
  GroupSizeSink group_sizes = {};
};

class Measurer {
 public:
  // Creates kernels lazily, once.
  explicit Measurer(gpu::Device& device, const spectrum::SpectrumLimits& limits = {});
  ~Measurer();

  // A geometry beyond a limit of the device gets `not_analysed` with need and limit, one whose signal alone
  // is beyond a limit `no_fourier_transform`. Throws gpu::DeviceLost. Cost: linear in triangles but for
  // sorting areas; device memory under 200 bytes per triangle (about 275 where all edges have more than two
  // triangles). The Fourier transform's start triangles are searched on all processors of the host, see
  // surface_distances/start_triangle.h for cost and memory there.
  void measure(Measurement measurement);

  // The same in two steps: up to here all that the device can do without start triangles, which are searched
  // until and beyond the return; then PendingMeasurement::finish. What is pending must be finished or
  // destroyed before the Measurer.
  std::unique_ptr<PendingMeasurement> start(Measurement measurement);

  struct Stages;  // kernels of every stage

 private:
  std::unique_ptr<Stages> stages_;
};

}  // namespace scene_analyzer::pipeline
