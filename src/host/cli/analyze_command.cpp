#include "cli/analyze_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "base/version.h"
#include "cli/analyze_options.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/lazy_device.h"
#include "cli/mesh_files.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

// The assets that could be analysed, in the order given, and whether all went well.
struct Analyses {
  std::vector<analysis::AssetAnalysis> assets;
  bool all_good = true;
};

// One spelling per file: an asset given twice is analysed once.
fs::path identity(const std::string& asset) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(asset, error);
  return error ? fs::path(asset) : canonical;
}

// Whether some asset will most likely be measured now. Only a guess about when to start the device: a stale
// file is noticed later, and then the device is made on demand.
bool measuring_is_likely(const AnalyzeRequest& request) {
  return std::ranges::any_of(request.assets, [&](const std::string& asset) {
    std::error_code ignored;
    if (!fs::is_regular_file(asset, ignored)) return false;
    return !request.pipeline.use_analysis_files || request.histograms || request.signals ||
           !fs::exists(analysis_file::path_for(asset, request.pipeline.cache_folder), ignored);
  });
}

void log_outcome(const std::string& asset, const pipeline::Outcome& outcome, double seconds) {
  for (const std::string& message : outcome.messages) log_warning(message);
  if (!outcome.error.empty()) log_error(outcome.error);
  if (outcome.analysis)
    log_detail(fmt::format("{}: {} in {:.3f} s", asset,
                           outcome.from_file ? "read from its analysis file" : "measured", seconds));
}

pipeline::Outcome analyze_one(pipeline::Pipeline& pipeline, const std::string& asset, Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const auto report_step = [&](double fraction, const std::string& step) {
    check_interrupt();
    progress.update(fraction, step);
  };
  pipeline::Outcome outcome = pipeline.analyze(asset, report_step);
  check_interrupt();  // Ctrl-C reaches the import worker too: its end is no fault of the asset
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  progress.aside([&] { log_outcome(asset, outcome, seconds.count()); });
  return outcome;
}

// What is written per mesh while assets are measured, where it was asked for.
struct Exports {
  std::optional<MeshFiles> histograms, signals;

  explicit Exports(const AnalyzeRequest& request) {
    if (request.histograms) histograms.emplace(*request.histograms, "histograms");
    if (request.signals) signals.emplace(*request.signals, "signals");
  }

  void start_asset(std::size_t rows_before) {
    for (auto* files : {&histograms, &signals})
      if (*files) (*files)->start_asset(rows_before);
  }

  // Whether all files could be written.
  bool log() {
    bool good = true;
    for (auto* files : {&histograms, &signals}) {
      if (!*files) continue;
      for (const std::string& warning : (*files)->take_warnings()) log_warning(warning);
      const auto errors = (*files)->take_errors();
      for (const std::string& error : errors) log_error(error);
      good = good && errors.empty();
    }
    return good;
  }
};

pipeline::Options pipeline_options(const AnalyzeRequest& request, Exports& exports) {
  pipeline::Options options = request.pipeline;
  using analysis::AssetAnalysis;
  if (exports.histograms)
    options.histograms = [&](const AssetAnalysis& analysis, std::uint32_t geometry, const auto& histogram) {
      write_histogram(*exports.histograms, analysis, geometry, histogram);
    };
  if (exports.signals)
    options.signals = [&](const AssetAnalysis& analysis, std::uint32_t geometry, const auto& signal) {
      write_signal(*exports.signals, analysis, geometry, signal);
    };
  return options;
}

Analyses analyze_all(const AnalyzeRequest& request, LazyDevice& device) {
  Analyses result;
  Exports exports(request);
  pipeline::Pipeline pipeline(pipeline_options(request, exports),
                              [&]() -> gpu::Device& { return device.get(); });
  if (measuring_is_likely(request)) device.start();
  std::size_t rows = 0;
  Progress progress(request.log != LogLevel::kQuiet, request.assets.size());
  constexpr std::size_t kFailed = static_cast<std::size_t>(-1);
  std::map<fs::path, std::size_t> seen;  // file -> index in result.assets
  for (std::size_t i = 0; i < request.assets.size(); ++i) {
    check_interrupt();
    const std::string& asset = request.assets[i];
    progress.start_asset(i, fs::path(asset).filename().string());
    const auto [entry, is_new] = seen.try_emplace(identity(asset), kFailed);
    if (is_new) {
      exports.start_asset(rows);
      pipeline::Outcome outcome = analyze_one(pipeline, asset, progress);
      progress.aside([&] { result.all_good = exports.log() && result.all_good; });
      if (outcome.analysis) {
        entry->second = result.assets.size();
        result.all_good = result.all_good && !is_beyond_a_limit(*outcome.analysis);
        result.assets.push_back(std::move(*outcome.analysis));
      }
    } else if (entry->second != kFailed) {
      analysis::AssetAnalysis copy = result.assets[entry->second];
      copy.asset = asset;
      result.assets.push_back(std::move(copy));
    }
    result.all_good = result.all_good && entry->second != kFailed;
    if (entry->second != kFailed) rows += result.assets.back().instances.size();
  }
  return result;
}

// Assets in metres beside assets in centimetres, or lying on their side, make one scene only by accident.
template <typename Value>
void warn_if_mixed(const std::vector<analysis::AssetAnalysis>& assets,
                   std::optional<Value> analysis::AssetAnalysis::*field, const char* what) {
  const analysis::AssetAnalysis* first = nullptr;
  for (const auto& asset : assets) {
    if (!(asset.*field)) continue;
    if (first == nullptr) first = &asset;
    if (*(asset.*field) == *(first->*field)) continue;
    log_warning(fmt::format("assets of one scene differ in {}: {} has {}, {} has {}; nothing is converted",
                            what, first->asset, *(first->*field), asset.asset, *(asset.*field)));
    return;
  }
}

report::SceneReport make_report(const AnalyzeRequest& request,
                                const std::vector<analysis::AssetAnalysis>& assets) {
  report::SceneReport report;
  report.tool_version = version();
  report.parameters = request.pipeline.parameters;
  report.options = request.ratings;
  report.assets = assets;
  report.rating = ratings::rate(assets, request.ratings);
  // The device that the figures come from, also when they were read from a file: a rerun prints the same.
  const auto measured =
      std::ranges::find_if(assets, [](const auto& asset) { return !asset.device.name.empty(); });
  if (measured != assets.end()) report.device = measured->device;
  return report;
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw InputError("standard output cannot be written");
}

// Each output is tried: a full disk for one of them is no reason to lose the others.
bool write_outputs(const AnalyzeRequest& request, const report::SceneReport& report) {
  bool good = true;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const InputError& error) {
      log_error(error.what());
      good = false;
    }
  };
  if (request.json) attempt([&] { report::write_file(*request.json, report::json(report)); });
  if (request.csv) attempt([&] { report::write_file(*request.csv, report::csv(report)); });
  if (request.table() && !report.assets.empty()) {
    report::TableStyle style;
    style.color = wants_color(STDOUT_FILENO);
    style.width = terminal_width(STDOUT_FILENO);
    attempt([&] { print(report::table(report, style)); });
  }
  return good;
}

void note_metrics_without_values(const AnalyzeRequest& request) {
  const std::size_t timing = index_of(analysis::Metric::kRenderingTime);
  if (!request.ratings.metrics.all() && request.ratings.metrics[timing])
    log_warning(fmt::format("--metrics: {} is not computed by this version; its values stay empty",
                            analysis::kMetricKeys[timing]));
}

}  // namespace

int analyze_command(std::span<const std::string> arguments) {
  const AnalyzeRequest request = parse_analyze(arguments);
  if (request.help) {
    print(analyze_help());
    return kSuccess;
  }
  set_up_logging(request.log);
  watch_interrupts();
  note_metrics_without_values(request);
  LazyDevice device(device_options(request.device));
  const Analyses analyses = analyze_all(request, device);
  warn_if_mixed(analyses.assets, &analysis::AssetAnalysis::unit_scale, "their unit in metres");
  warn_if_mixed(analyses.assets, &analysis::AssetAnalysis::up_axis, "their up axis");
  // Wrong use of the device makes every figure doubtful: nothing is written.
  const auto validation = device.take_validation_messages();
  for (const std::string& message : validation) log_error(message);
  if (!validation.empty()) return kUnusable;
  const bool written = write_outputs(request, make_report(request, analyses.assets));
  return written && analyses.all_good ? kSuccess : kInputFailed;
}

}  // namespace scene_analyzer::cli
