// pipeline.h — Asset path -> analysis, through the analysis file when it is still true: the product's
// summary.
//
//   analysis file valid?  -> done, without import; the GPU at most tells its name (this_device_only)
//   import (worker)       -> Scene
//   measure (GPU)         -> AssetAnalysis
//   time (GPU)            -> its rendering times
//   store analysis file   -> the next run is instant
//
// start() returns when nothing but start triangles and spectra are missing, so that the next asset can be
// imported and measured while the host searches.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "import/import.h"
#include "pipeline/analysis_store.h"
#include "pipeline/measure.h"
#include "render_timing/render_timer.h"

namespace scene_analyzer::pipeline {

struct Options {
  analysis::Parameters parameters;
  analysis::MetricSet metrics = analysis::MetricSet().set();
  bool use_analysis_files = true;                     // --no-cache: neither read nor written
  std::optional<std::filesystem::path> cache_folder;  // --cache-dir
  std::shared_ptr<AnalysisStore> store = {};          // in place of the two above
  bool fingerprint_files = false;  // AssetAnalysis::files is wanted also without analysis files
  import::Limits import_limits;
  // Rendering time: pixels, and seconds for all meshes of one asset together.
  std::uint32_t timing_width = 512, timing_height = 512;
  double timing_budget = 30;
  // Rendering times of other devices than the one that `device` gives are not good enough.
  bool this_device_only = false;
  // Takes histograms as they are computed; `analysis` has all its instances by then. Analysis files hold no
  // histograms: with it every asset is imported and measured.
  std::function<void(const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                     const analysis::Histogram& histogram)>
      histograms;
  // The same for signals and their spectra, which includes the Fourier rating.
  std::function<void(const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                     const analysis::SignalSpectrum& signal)>
      signals;
};

// What became of one asset. Exactly one of `analysis` and `error` is meaningful.
struct Outcome {
  std::optional<analysis::AssetAnalysis> analysis;
  std::string error;                         // names the file and the reason
  bool may_succeed_alone = false;            // with less going on beside it; where there is an error
  bool from_file = false;                    // the analysis file was valid
  bool kept = false;                         // the analysis file is there for the next run
  std::string write_error;                   // why it could not be written, naming it; or empty
  bool others_can_be_written = false;        // where there is a write_error
  std::optional<mesh::ImportEffort> import;  // where it was not, and the import succeeded
  std::vector<std::string> messages;  // for the log, at warning level: analysis file stale, folder read-only,
                                      // import warnings, meshes beyond a limit
};

class PendingAnalysis;
class PendingPack;

class Pipeline {
 public:
  // `options` are those of every asset that is not given others. `device` is called when something has to be
  // computed for the first time, and again after forget_device().
  Pipeline(Options options, std::function<gpu::Device&()> device);
  ~Pipeline();

  // None of these throws for a bad asset (that is an Outcome); they throw gpu::NoDevice and gpu::DeviceLost,
  // after which the rest makes no sense.
  Outcome analyze(const mesh::AssetSource& asset, const Progress& progress = {});

  // The same in two steps. Each asset that was started holds its scene in memory until it is finished, and
  // its search has threads on all processors: few should be pending. Destroy them before the pipeline.
  // Where is_timed_alone(), finish what is pending before the next is started.
  std::unique_ptr<PendingAnalysis> start(const mesh::AssetSource& asset, const Progress& progress = {});
  // Of what has nothing to measure by any thread, several at the same time.
  Outcome finish(std::unique_ptr<PendingAnalysis> pending);
  // Whether rendering is timed on a device that a search on the host would slow down; of assets that were
  // given no options of their own.
  bool is_timed_alone() const { return is_timed_alone(*options_); }
  bool is_timed_alone(const Options& options) const;

  // start() in two steps, for many assets. The first may be taken by several threads at the same time: reads
  // the analysis file or imports the asset. Throws import::Stopped. Memory: the scene, until it is finished.
  // With `options` for this asset.
  std::unique_ptr<PendingAnalysis> prepare(const mesh::AssetSource& asset, const Progress& progress = {},
                                           const std::shared_ptr<const Options>& options = nullptr);
  // The second, for one thread. A single asset is measured as by start(); the meshes of several share batches
  // on the device where their parameters and metrics are the same, with the results that each would have had
  // alone. All were made by prepare() of this pipeline; without Options::histograms and signals.
  std::unique_ptr<PendingPack> start_pack(std::vector<std::unique_ptr<PendingAnalysis>> assets);
  // Calls `finished` for each, in the order given, as soon as it is stored: rendering is timed asset by
  // asset, each of which may take Options::timing_budget. What `finished` throws leaves the others undone.
  using Finished = std::function<void(std::size_t index, Outcome outcome)>;
  void finish_pack(std::unique_ptr<PendingPack> pack, const Finished& finished);

  // What is measured on. Throws gpu::NoDevice.
  gpu::Device& device();
  analysis::DeviceStamp device_stamp();
  // After gpu::DeviceLost, when nothing is pending any more but what prepare() made: the next measurement
  // asks for a device again.
  void forget_device();

 private:
  // Whether a valid analysis file holds all `wanted` metrics. If it holds others only, they are added to
  // `wanted`.
  bool reuse(PendingAnalysis& pending, analysis::MetricSet& wanted);
  void compute(PendingAnalysis& pending, analysis::MetricSet wanted);
  Outcome finish(PendingAnalysis& pending);
  void measure(PendingAnalysis& pending);
  void measure_together(PendingPack& pack);
  void complete_together(PendingPack& pack);
  void store(PendingAnalysis& pending);

  // What others than the measuring thread may ask of the device, which that one may lose meanwhile.
  struct KnownDevice {
    gpu::DeviceInfo info;
    analysis::DeviceStamp stamp;
  };
  // Makes what depends on the device. The first to need it may be any thread.
  std::shared_ptr<const KnownDevice> start_device();
  void find_times(PendingAnalysis& pending);
  void time(PendingAnalysis& pending);
  bool can_time(Outcome& outcome);  // says it in `outcome` when the device cannot
  void keep_wanted_timings(const Options& options, analysis::AssetAnalysis& analysis);
  // What rendering times have to be made under.
  analysis::RenderTiming::Conditions timing_conditions(const Options& options);

  const std::shared_ptr<const Options> options_;
  const std::function<gpu::Device&()> device_;
  mutable std::mutex device_mutex_;  // while it is made; what is made of it stays until forget_device()
  std::shared_ptr<const KnownDevice> known_device_;
  std::unique_ptr<Measurer> measurer_;
  std::unique_ptr<render_timing::RenderTimer> render_timer_;
  gpu::Device* gpu_ = nullptr;
  std::mutex folders_mutex_;
  std::set<std::filesystem::path> unwritable_folders_;  // already complained about
};

}  // namespace scene_analyzer::pipeline
