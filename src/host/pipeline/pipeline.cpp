#include "pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "gpu/error.h"
#include "pipeline/pending_analysis.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using analysis::MetricSet;

// Share of an asset's progress that is over when the measuring begins, and when it ends.
constexpr double kImported = 0.2;
constexpr double kMeasuredBeforeTiming = 0.4;
constexpr double kMeasured = 0.95;
// Meshes named one by one in a message; a library of thousands would bury everything else.
constexpr std::size_t kNamedMeshes = 5;

MetricSet set_of(std::initializer_list<Metric> metrics) {
  MetricSet set;
  for (const Metric metric : metrics) set.set(index_of(metric));
  return set;
}

// What is measured on the GPU and an analysis file may lack.
const MetricSet kOptionalMetrics =
    set_of({Metric::kPolygonsPerPlanarGroup, Metric::kPlanarGroupVariation, Metric::kCooccurrenceContrast,
            Metric::kFourierTransform, Metric::kRenderingTime});
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

const std::string& name_of(const AssetAnalysis& analysis, std::size_t geometry) {
  static const std::string kUnused = "not placed by any node";
  const auto user = std::ranges::find(analysis.instances, geometry, &analysis::InstanceAnalysis::geometry);
  return user == analysis.instances.end() ? kUnused : user->mesh.empty() ? user->node : user->mesh;
}

void describe_limits(const AssetAnalysis& analysis, std::vector<std::string>& messages) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < analysis.geometries.size(); ++i) {
    const auto& geometry = analysis.geometries[i];
    if (!is_beyond_a_limit(geometry) || ++beyond > kNamedMeshes) continue;
    const bool wholly = !geometry.not_analysed.empty();
    messages.push_back(fmt::format("{}: mesh {} ({}) {}: {}", analysis.asset, geometry.mesh,
                                   name_of(analysis, i), wholly ? "is not analysed" : "has no Fourier rating",
                                   wholly ? geometry.not_analysed : geometry.no_fourier_transform));
  }
  if (beyond > kNamedMeshes)
    messages.push_back(fmt::format("{}: {} more meshes are not analysed for such reasons", analysis.asset,
                                   beyond - kNamedMeshes));
}

// What a user has to know about these results, whether they were just computed or read.
void describe(const AssetAnalysis& analysis, std::vector<std::string>& messages) {
  for (const std::string& warning : analysis.warnings)
    messages.push_back(fmt::format("{}: {}", analysis.asset, warning));
  describe_limits(analysis, messages);
  if (is_beyond_a_limit(analysis)) return;
  const auto has_triangles = [](const auto& geometry) { return geometry.triangles > 0; };
  if (std::ranges::any_of(analysis.geometries, has_triangles)) return;
  const auto has_source = [](const auto& geometry) { return geometry.source_triangles > 0; };
  messages.push_back(fmt::format("{}: {}; there is nothing to rate", analysis.asset,
                                 std::ranges::any_of(analysis.geometries, has_source)
                                     ? "all its triangles are degenerate"
                                     : "it has no triangles"));
}

bool has_something_to_draw(const AssetAnalysis& analysis) {
  return std::ranges::any_of(analysis.geometries,
                             [](const auto& geometry) { return geometry.triangles > 0; });
}

// Times that are missing may be there on the next try.
AssetAnalysis without_incomplete_timings(AssetAnalysis analysis) {
  std::erase_if(analysis.timings, is_incomplete);
  analysis.computed.set(kTiming, !analysis.timings.empty());
  return analysis;
}

void say_what_is_missing(const analysis::RenderTiming& timing, Outcome& outcome) {
  const auto missing = [](const auto& time) { return !time.not_measured.empty(); };
  const auto first = std::ranges::find_if(timing.times, missing);
  if (first == timing.times.end()) return;
  const auto count = std::ranges::count_if(timing.times, missing);
  outcome.messages.push_back(fmt::format("{}: the rendering time of {} {} is not measured: {}",
                                         outcome.analysis->asset, count, count == 1 ? "mesh" : "meshes",
                                         first->not_measured));
}

// An asset without any mesh still has its row, so that nobody wonders where it went.
void add_empty_row(AssetAnalysis& analysis) {
  analysis.geometries.assign(1, {});
  analysis.instances.assign(1, {});
}

// Runs a step of an asset's analysis; what is wrong with the asset goes into its outcome.
void attempt(const fs::path& asset, Outcome& outcome, const std::function<void()>& step) {
  try {
    step();
  } catch (const InputError& error) {
    outcome.error = error.what();
  } catch (const fs::filesystem_error& error) {
    outcome.error = fmt::format("{}: {}", asset.string(), error.code().message());
  } catch (const std::bad_alloc&) {
    outcome.error = fmt::format("{}: this machine has too little free memory for it", asset.string());
  }
}

}  // namespace

Pipeline::Pipeline(Options options, std::function<gpu::Device&()> device)
    : options_(std::move(options)), device_(std::move(device)) {}

Pipeline::~Pipeline() = default;

Outcome Pipeline::analyze(const fs::path& asset, const Progress& progress) {
  return finish(start(asset, progress));
}

std::unique_ptr<PendingAnalysis> Pipeline::start(const fs::path& asset, const Progress& progress) {
  std::unique_ptr<PendingAnalysis> pending(new PendingAnalysis(
      asset, progress ? progress : [](double, const std::string&) {}));
  attempt(asset, pending->outcome_, [&] {
    MetricSet wanted = options_.metrics & kOptionalMetrics;
    // A signal's summary is stored: it has to count as computed, for its parameter to be compared later.
    if (options_.signals) wanted.set(index_of(Metric::kFourierTransform));
    if (!options_.use_analysis_files || !reuse(*pending, wanted)) compute(*pending, wanted);
  });
  return pending;
}

Outcome Pipeline::finish(std::unique_ptr<PendingAnalysis> pending) {
  Outcome& outcome = pending->outcome_;
  attempt(pending->asset_, outcome, [&] {
    if (!outcome.error.empty()) return;
    if (pending->measurement_) pending->measurement_->finish();
    if (pending->computed_ && options_.use_analysis_files) store(*pending);
    keep_wanted_timings(*outcome.analysis);
    describe(*outcome.analysis, outcome.messages);
  });
  if (!outcome.error.empty()) outcome.analysis.reset();
  return std::move(outcome);
}

bool Pipeline::reuse(PendingAnalysis& pending, MetricSet& wanted) {
  pending.report(0, "checking the analysis file");
  const fs::path file = analysis_file::path_for(pending.asset_, options_.cache_folder);
  auto loaded = analysis_file::load_valid(file, pending.asset_, options_.parameters);
  Outcome& outcome = pending.outcome_;
  if (const auto* unusable = std::get_if<analysis_file::Unusable>(&loaded)) {
    if (!unusable->absent)
      outcome.messages.push_back(fmt::format("{}: the analysis file {} {}; it is computed again",
                                             pending.asset_.string(), file.string(), unusable->reason));
    return false;
  }
  auto& stored = std::get<AssetAnalysis>(loaded);
  const MetricSet untimed = ~set_of({Metric::kRenderingTime});
  const auto* timing =
      wanted[kTiming] ? find_timing(stored.timings, timing_conditions(), options_.timing_budget) : nullptr;
  if (!covers(stored.computed, wanted & untimed) || options_.histograms || options_.signals ||
      (wanted[kTiming] && timing == nullptr && has_something_to_draw(stored) && can_time(outcome))) {
    // Computing only what is missing would lose what the next run may ask for; times are kept as they are.
    wanted |= stored.computed & kOptionalMetrics & untimed;
    pending.stored_timings_ = std::move(stored.timings);
    pending.stored_files_ = std::move(stored.files);
    return false;
  }
  if (timing != nullptr) put_first(stored.timings, analysis::RenderTiming(*timing));
  stored.asset = pending.asset_.string();
  outcome.analysis = std::move(stored);
  outcome.from_file = true;
  return true;
}

void Pipeline::compute(PendingAnalysis& pending, MetricSet wanted) {
  pending.report(0, "importing");
  pending.computed_ = true;
  const FileState before = state_of(pending.asset_);
  pending.scene_ = import::import_asset(pending.asset_, options_.import_limits);
  const mesh::Scene& scene = pending.scene_;
  AssetAnalysis& analysis = pending.outcome_.analysis.emplace();
  // Hashed now, not when it is stored: what is measured is what was read.
  if (options_.use_analysis_files) analysis.files = analysis_file::fingerprint(pending.asset_, scene.files);
  pending.unchanged_ = before == state_of(pending.asset_);
  analysis.asset = pending.asset_.string();
  analysis.format = scene.format;
  analysis.unit_scale = scene.unit_scale;
  analysis.up_axis = scene.up_axis;
  analysis.parameters = options_.parameters;
  analysis.computed = wanted | kCommonMetrics;
  analysis.warnings = scene.warnings;
  // Times of the files as they were hashed for them, and of no others.
  if (analysis.files == pending.stored_files_) analysis.timings = std::move(pending.stored_timings_);
  if (scene.instances.empty())
    add_empty_row(analysis);
  else
    measure(pending, wanted);
}

void Pipeline::start_device() {
  if (measurer_) return;
  gpu::Device& device = device_();
  device_info_ = &device.info();
  device_stamp_ = {device_info_->name, device_info_->driver, gpu::to_string(device_info_->type),
                   device_info_->id};
  measurer_ = std::make_unique<Measurer>(device);
  gpu_ = &device;
}

void Pipeline::measure(PendingAnalysis& pending, MetricSet wanted) {
  pending.report(kImported, "starting the device");
  start_device();
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  analysis.device = device_stamp_;
  const double measured = wanted[kTiming] ? kMeasuredBeforeTiming : kMeasured;
  Measurement measurement{.scene = pending.scene_,
                          .analysis = analysis,
                          .parameters = options_.parameters,
                          .metrics = wanted,
                          .progress = [&pending, measured](double fraction, const std::string& step) {
                            pending.report(kImported + (measured - kImported) * fraction, step);
                          }};
  if (options_.histograms)
    measurement.histograms = [&](std::uint32_t geometry, const analysis::Histogram& histogram) {
      options_.histograms(analysis, geometry, histogram);
    };
  if (options_.signals)
    measurement.signals = [&](std::uint32_t geometry, const analysis::SignalSpectrum& signal) {
      options_.signals(analysis, geometry, signal);
    };
  if (wanted[kTiming])
    measurement.degenerate = [&pending](std::uint32_t geometry, std::vector<std::uint32_t> triangles) {
      pending.degenerate_[geometry] = std::move(triangles);
    };
  pending.measurement_ = measurer_->start(std::move(measurement));
  if (!wanted[kTiming]) return;
  if (const auto* stored = find_timing(analysis.timings, timing_conditions(), options_.timing_budget)) {
    put_first(analysis.timings, analysis::RenderTiming(*stored));
    return;
  }
  // Devices that share anything with the processors would be timed with the search beside them.
  if (is_timed_alone()) std::exchange(pending.measurement_, nullptr)->finish();
  time(pending);
}

bool Pipeline::is_timed_alone() const {
  return options_.metrics[kTiming] && device_info_ != nullptr &&
         device_info_->type != gpu::DeviceType::kDiscrete;
}

analysis::RenderTiming::Conditions Pipeline::timing_conditions() {
  if (options_.this_device_only) start_device();
  return {.device = options_.this_device_only ? device_stamp_ : analysis::DeviceStamp(),
          .width = options_.timing_width,
          .height = options_.timing_height,
          .steps = options_.parameters.steps};
}

bool Pipeline::can_time(Outcome& outcome) {
  start_device();
  const std::string reason = render_timing::why_not(*device_info_);
  if (!reason.empty()) outcome.messages.push_back("rendering time is not measured: " + reason);
  return reason.empty();
}

// What was stored under other conditions is not what was asked for.
void Pipeline::keep_wanted_timings(AssetAnalysis& analysis) {
  std::erase_if(analysis.timings, [&](const analysis::RenderTiming& timing) {
    return !options_.metrics[kTiming] || !is_under(timing, timing_conditions());
  });
}

void Pipeline::time(PendingAnalysis& pending) {
  if (!can_time(pending.outcome_)) return;
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  analysis::RenderTiming::Conditions conditions = timing_conditions();
  conditions.device = device_stamp_;
  const auto progress = [&](double fraction) {
    pending.report(kMeasuredBeforeTiming + (kMeasured - kMeasuredBeforeTiming) * fraction, "rendering time");
  };
  progress(0);
  try {
    if (!render_timer_) render_timer_ = std::make_unique<render_timing::RenderTimer>(*gpu_);
    analysis::RenderTiming timing = time_scene(*render_timer_, pending.scene_, analysis, pending.degenerate_,
                                               conditions, options_.timing_budget, progress);
    timing.timestamp_period_ns = device_info_->timestamp_period_ns;
    timing.budget_seconds = options_.timing_budget;
    say_what_is_missing(timing, pending.outcome_);
    put_first(analysis.timings, std::move(timing));
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const gpu::Error& error) {
    pending.outcome_.messages.push_back(
        fmt::format("{}: rendering time is not measured: {}", analysis.asset, error.what()));
  }
}

void Pipeline::store(PendingAnalysis& pending) {
  Outcome& outcome = pending.outcome_;
  // What did not fit may fit on another device, or when other programs have ended: such a result is not the
  // asset's.
  if (is_beyond_a_limit(*outcome.analysis)) return;
  pending.report(kMeasured, "writing the analysis file");
  if (!pending.unchanged_) {
    outcome.messages.push_back(fmt::format("{}: the file changed while it was read; its analysis is not kept",
                                           pending.asset_.string()));
    return;
  }
  const fs::path file = analysis_file::path_for(pending.asset_, options_.cache_folder);
  try {
    analysis_file::store(file, without_incomplete_timings(*outcome.analysis));
  } catch (const InputError& error) {
    // Results are as good as ever, only the next run takes as long as this one.
    const fs::path folder = options_.cache_folder.value_or(file.parent_path());
    if (unwritable_folders_.insert(folder).second)
      outcome.messages.push_back(fmt::format("{}; analyses of this folder are not kept", error.what()));
  }
}

}  // namespace scene_analyzer::pipeline
