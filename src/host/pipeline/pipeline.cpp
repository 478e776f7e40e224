#include "pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "pipeline/attempt.h"
#include "pipeline/messages.h"
#include "pipeline/pending_analysis.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using analysis::MetricSet;

MetricSet set_of(std::initializer_list<Metric> metrics) {
  MetricSet set;
  for (const Metric metric : metrics) set.set(index_of(metric));
  return set;
}

// What is measured on the GPU and an analysis file may lack.
const MetricSet kOptionalMetrics =
    set_of({Metric::kPolygonsPerPlanarGroup, Metric::kPlanarGroupVariation, Metric::kCooccurrenceContrast,
            Metric::kFourierTransform, Metric::kRenderingTime});
constexpr std::size_t kMostTimings = 64;  // that are kept of one asset
constexpr std::size_t kTiming = index_of(Metric::kRenderingTime);
// Their stored part is counts, areas and bounds, which every analysis holds.
const MetricSet kCommonMetrics = set_of({Metric::kRelativeDensity, Metric::kDistance});

bool covers(MetricSet stored, MetricSet wanted) {
  return (wanted & ~stored).none();
}

// The asset's size and time, to notice that it was changed while it was read.
struct FileState {
  std::uintmax_t size = 0;
  fs::file_time_type time;
  bool operator==(const FileState&) const = default;
};

FileState state_of(const fs::path& file) {
  std::error_code ignored;  // the import reports what is wrong with it
  return {fs::file_size(file, ignored), fs::last_write_time(file, ignored)};
}

bool has_something_to_draw(const AssetAnalysis& analysis) {
  return std::ranges::any_of(analysis.geometries,
                             [](const auto& geometry) { return geometry.triangles > 0; });
}

// Of an older program, which did not look for defects or hash shapes.
bool is_of_an_older_program(const AssetAnalysis& analysis) {
  return std::ranges::any_of(analysis.geometries, [](const auto& geometry) {
    return geometry.source_triangles > 0 &&
           ((geometry.not_analysed.empty() && !geometry.defects) || !geometry.shape_hash);
  });
}

// Times that are missing may be there on the next try.
AssetAnalysis without_incomplete_timings(AssetAnalysis analysis) {
  std::erase_if(analysis.timings, is_incomplete);
  if (analysis.timings.size() > kMostTimings) analysis.timings.resize(kMostTimings);  // the newest come first
  analysis.computed.set(kTiming, !analysis.timings.empty());
  return analysis;
}

std::shared_ptr<AnalysisStore> store_of(const Options& options) {
  if (options.store || !options.use_analysis_files) return options.store;
  return std::make_shared<AnalysisFiles>(options.cache_folder);
}

// An asset without any mesh still has its row, so that nobody wonders where it went.
void add_empty_row(AssetAnalysis& analysis) {
  analysis.geometries.assign(1, {});
  analysis.instances.assign(1, {});
}

// Counted as the import does: a mesh is one, whatever transforms made of it.
bool has_more_triangles(const AssetAnalysis& analysis, std::uint64_t limit) {
  if (limit == 0) return false;
  std::set<std::uint32_t> meshes;
  std::uint64_t triangles = 0;
  for (const auto& geometry : analysis.geometries)
    if (meshes.insert(geometry.mesh).second) triangles += geometry.source_triangles;
  return triangles > limit;
}

}  // namespace

PendingAnalysis::PendingAnalysis(mesh::AssetSource asset, Progress report,
                                 std::shared_ptr<const Options> options)
    : asset_(std::move(asset)),
      progress_(report ? std::move(report) : [](double, const std::string&) {}),
      options_(std::move(options)),
      store_(store_of(*options_)) {}

Pipeline::Pipeline(Options options, std::function<gpu::Device&()> device)
    : options_(std::make_shared<const Options>(std::move(options))), device_(std::move(device)) {}

Pipeline::~Pipeline() = default;

Outcome Pipeline::analyze(const mesh::AssetSource& asset, const Progress& progress) {
  return finish(start(asset, progress));
}

std::unique_ptr<PendingAnalysis> Pipeline::start(const mesh::AssetSource& asset, const Progress& progress) {
  auto pending = prepare(asset, progress);
  if (!pending->has_something_to_measure()) return pending;
  attempt(asset, pending->outcome_, [&] {
    measure(*pending);
    if (pending->wanted_[kTiming]) find_times(*pending);
  });
  return pending;
}

std::unique_ptr<PendingAnalysis> Pipeline::prepare(const mesh::AssetSource& asset, const Progress& progress,
                                                   const std::shared_ptr<const Options>& options) {
  std::unique_ptr<PendingAnalysis> pending(
      new PendingAnalysis(asset, progress, options ? options : options_));
  attempt(asset, pending->outcome_, [&] {
    MetricSet wanted = pending->options_->metrics & kOptionalMetrics;
    // A signal's summary is stored: it has to count as computed, for its parameter to be compared later.
    if (pending->options_->signals) wanted.set(index_of(Metric::kFourierTransform));
    if (!pending->store_ || !reuse(*pending, wanted)) compute(*pending, wanted);
  });
  return pending;
}

Outcome Pipeline::finish(std::unique_ptr<PendingAnalysis> pending) {
  return finish(*pending);
}

Outcome Pipeline::finish(PendingAnalysis& pending) {
  Outcome& outcome = pending.outcome_;
  attempt(pending.asset_, outcome, [&] {
    if (!outcome.error.empty()) return;
    if (pending.measurement_) pending.measurement_->finish();
    if (pending.computed_ && pending.store_) store(pending);
    keep_wanted_timings(*pending.options_, *outcome.analysis);
    describe(*outcome.analysis, outcome.messages);
  });
  if (!outcome.error.empty()) outcome.analysis.reset();
  return std::move(outcome);
}

bool Pipeline::reuse(PendingAnalysis& pending, MetricSet& wanted) {
  pending.report(0, "checking the analysis file");
  const Options& options = *pending.options_;
  AnalysisStore::Found found = pending.store_->find(pending.asset_, options.parameters);
  Outcome& outcome = pending.outcome_;
  if (!found.analysis) {
    if (!found.unusable.empty())
      outcome.messages.push_back(
          fmt::format("{}: {}; it is computed again", pending.asset_.name, found.unusable));
    return false;
  }
  AssetAnalysis& stored = *found.analysis;
  if (has_more_triangles(stored, options.import_limits.triangles)) return false;  // the import refuses it
  const MetricSet untimed = ~set_of({Metric::kRenderingTime});
  const auto* timing = wanted[kTiming]
                           ? find_timing(stored.timings, timing_conditions(options), options.timing_budget)
                           : nullptr;
  if (!covers(stored.computed, wanted & untimed) || is_of_an_older_program(stored) || options.histograms ||
      options.signals ||
      (wanted[kTiming] && timing == nullptr && has_something_to_draw(stored) && can_time(outcome))) {
    // Computing only what is missing would lose what the next run may ask for; times are kept as they are.
    wanted |= stored.computed & kOptionalMetrics & untimed;
    pending.stored_timings_ = std::move(stored.timings);
    pending.stored_files_ = std::move(stored.files);
    return false;
  }
  if (timing != nullptr) put_first(stored.timings, analysis::RenderTiming(*timing));
  stored.asset = pending.asset_.name;
  outcome.analysis = std::move(stored);
  outcome.from_file = outcome.kept = true;
  return true;
}

void Pipeline::compute(PendingAnalysis& pending, MetricSet wanted) {
  pending.report(0, "importing");
  pending.computed_ = true;
  const Options& options = *pending.options_;
  const FileState before = state_of(pending.asset_.file);
  pending.scene_ = import::import_asset(pending.asset_, options.import_limits);
  const mesh::Scene& scene = pending.scene_;
  pending.outcome_.import = scene.effort;
  AssetAnalysis& analysis = pending.outcome_.analysis.emplace();
  // Hashed now, not when it is stored: what is measured is what was read.
  if (pending.store_ || options.fingerprint_files)
    analysis.files = analysis_file::fingerprint(pending.asset_, scene.files);
  pending.unchanged_ = before == state_of(pending.asset_.file);
  analysis.asset = pending.asset_.name;
  analysis.format = scene.format;
  analysis.unit_scale = scene.unit_scale;
  analysis.up_axis = scene.up_axis;
  analysis.parameters = options.parameters;
  analysis.computed = wanted | kCommonMetrics;
  analysis.warnings = scene.warnings;
  // Times of the files as they were hashed for them, and of no others.
  if (analysis.files == pending.stored_files_) analysis.timings = std::move(pending.stored_timings_);
  pending.wanted_ = wanted;
  if (scene.instances.empty()) add_empty_row(analysis);
}

std::shared_ptr<const Pipeline::KnownDevice> Pipeline::start_device() {
  const std::lock_guard lock(device_mutex_);
  if (known_device_) return known_device_;
  gpu::Device& device = device_();
  const gpu::DeviceInfo& info = device.info();
  measurer_ = std::make_unique<Measurer>(device);
  gpu_ = &device;
  known_device_ = std::make_shared<const KnownDevice>(
      KnownDevice{info, {info.name, info.driver, gpu::to_string(info.type), info.id}});
  return known_device_;
}

gpu::Device& Pipeline::device() {
  start_device();
  return *gpu_;
}

analysis::DeviceStamp Pipeline::device_stamp() {
  return start_device()->stamp;
}

void Pipeline::forget_device() {
  const std::lock_guard lock(device_mutex_);
  render_timer_.reset();
  measurer_.reset();
  gpu_ = nullptr;
  known_device_ = nullptr;
}

void Pipeline::measure(PendingAnalysis& pending) {
  const MetricSet wanted = pending.wanted_;
  const Options& options = *pending.options_;
  pending.report(kImportEnds, "starting the device");
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  analysis.device = start_device()->stamp;
  const double measured = wanted[kTiming] ? kTimingBegins : kTimingEnds;
  Measurement measurement{.scene = pending.scene_,
                          .analysis = analysis,
                          .parameters = options.parameters,
                          .metrics = wanted,
                          .progress = [&pending, measured](double fraction, const std::string& step) {
                            pending.report(kImportEnds + (measured - kImportEnds) * fraction, step);
                          }};
  if (options.histograms)
    measurement.histograms = [&](std::uint32_t geometry, const analysis::Histogram& histogram) {
      options.histograms(analysis, geometry, histogram);
    };
  if (options.signals)
    measurement.signals = [&](std::uint32_t geometry, const analysis::SignalSpectrum& signal) {
      options.signals(analysis, geometry, signal);
    };
  if (wanted[kTiming])
    measurement.degenerate = [&pending](std::uint32_t geometry, std::vector<std::uint32_t> triangles) {
      pending.degenerate_[geometry] = std::move(triangles);
    };
  pending.measurement_ = measurer_->start(std::move(measurement));
}

void Pipeline::find_times(PendingAnalysis& pending) {
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  const Options& options = *pending.options_;
  if (const auto* stored = find_timing(analysis.timings, timing_conditions(options), options.timing_budget)) {
    put_first(analysis.timings, analysis::RenderTiming(*stored));
    return;
  }
  // Devices that share anything with the processors would be timed with the search beside them.
  if (is_timed_alone(options) && pending.measurement_) std::exchange(pending.measurement_, nullptr)->finish();
  time(pending);
}

void Pipeline::store(PendingAnalysis& pending) {
  Outcome& outcome = pending.outcome_;
  // What did not fit may fit on another device, or when other programs have ended: such a result is not the
  // asset's.
  if (is_beyond_a_limit(*outcome.analysis)) return;
  pending.report(kTimingEnds, "writing the analysis file");
  if (!pending.unchanged_) {
    outcome.messages.push_back(
        fmt::format("{}: the file changed while it was read; its analysis is not kept", pending.asset_.name));
    return;
  }
  try {
    pending.store_->keep(pending.asset_, without_incomplete_timings(*outcome.analysis));
    outcome.kept = true;
  } catch (const analysis_file::CannotStore& error) {
    // Results are as good as ever, only the next run takes as long as this one.
    outcome.write_error = error.what();
    outcome.others_can_be_written = error.is_the_assets();
    const std::lock_guard lock(folders_mutex_);
    if (error.is_the_assets())
      outcome.messages.push_back(fmt::format("{}; this analysis is not kept", error.what()));
    else if (unwritable_folders_.insert(pending.store_->folder_of(pending.asset_)).second)
      outcome.messages.push_back(fmt::format(
          "{} (choose another folder with --cache-dir, or go without with --no-cache); analyses of "
          "this folder are not kept",
          error.what()));
  }
}

}  // namespace scene_analyzer::pipeline
