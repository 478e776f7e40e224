#include "cli/analyze_assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "analysis_file/analysis_file.h"
#include "cli/interrupt.h"
#include "cli/mesh_files.h"
#include "cli/progress.h"
#include "cli/run_state.h"
#include "import/import.h"
#include "pipeline/pending_analysis.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

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

std::string effort_text(const std::string& asset, const mesh::ImportEffort& effort) {
  constexpr double kMiB = 1 << 20;
  return fmt::format(
      "{}: imported in {:.3f} s; its arrays take {:.1f} MiB, the import worker's peak was {:.1f} MiB", asset,
      effort.seconds, static_cast<double>(effort.answer_bytes) / kMiB,
      static_cast<double>(effort.worker_peak_bytes) / kMiB);
}

void log_outcome(const std::string& asset, const pipeline::Outcome& outcome, double seconds) {
  for (const std::string& message : outcome.messages) log_warning(message);
  if (!outcome.error.empty()) log_error(outcome.error);
  if (outcome.import) log_detail(effort_text(asset, *outcome.import));
  if (outcome.analysis)
    log_detail(fmt::format("{}: {} in {:.3f} s", asset,
                           outcome.from_file ? "read from its analysis file" : "measured", seconds));
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

  bool wanted() const { return histograms || signals; }

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

class AssetLoop {
 public:
  AssetLoop(const AnalyzeRequest& request, LazyDevice& device)
      : request_(request),
        exports_(request),
        pipeline_(pipeline_options(request, exports_), [&device]() -> gpu::Device& { return device.get(); }),
        progress_(request.log != LogLevel::kQuiet, request.assets.size()),
        analyses_(request.assets.size()),
        errors_(request.assets.size()),
        kept_(request.assets.size()) {}

  Analyses run() {
    begin_run(request_.assets.size());
    std::map<fs::path, std::size_t> seen;
    std::vector<std::size_t> first_of(request_.assets.size());
    try {
      for (std::size_t i = 0; i < request_.assets.size(); ++i) {
        check_interrupt();
        progress_.start_asset(i, fs::path(request_.assets[i]).filename().string());
        first_of[i] = seen.try_emplace(identity(request_.assets[i]), i).first->second;
        if (first_of[i] == i)
          start(i);
        else
          close(i, first_of[i]);
      }
      finish_all_but(0);
    } catch (const Interrupted&) {
      keep_what_is_ready();
      throw;
    }
    return collect(first_of);
  }

 private:
  struct Pending {
    std::size_t asset = 0;
    std::chrono::steady_clock::duration work{};  // of this asset, without what was done for others meanwhile
    std::unique_ptr<pipeline::PendingAnalysis> analysis;
  };

  // Adds the time that `work` takes to `total`.
  template <typename Work>
  static auto timed(std::chrono::steady_clock::duration& total, const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    auto result = work();
    total += std::chrono::steady_clock::now() - begin;
    return result;
  }

  void start(std::size_t asset) {
    finish_ready();
    if (pipeline_.is_timed_alone()) finish_all_but(0);
    exports_.start_asset(rows_);
    begin(asset);
    // With a search beside it an asset has less memory and less time: so that no result depends on the
    // neighbour, what failed is tried again alone.
    if (pending_.size() == 2 && pending_.back().analysis->has_failed()) {
      pending_.pop_back();
      finish_all_but(0);
      begin(asset);
    }
    finish_all_but(1);
    finish_ready();
  }

  void begin(std::size_t asset) {
    const auto report = [this, asset](double fraction, const std::string& step) {
      if (!stopping_) check_interrupt();
      progress_.update(asset, fraction, step);
    };
    Pending next;
    next.asset = asset;
    try {
      next.analysis = timed(next.work, [&] { return pipeline_.start(request_.assets[asset], report); });
    } catch (const import::Stopped&) {
      check_interrupt();
      throw;
    }
    pending_.push_back(std::move(next));
    check_interrupt();  // Ctrl-C reaches the import worker too: its end is no fault of the asset
  }

  // Files of meshes are named after rows of the report, which are known when all assets before are finished.
  void finish_ready() {
    while (!pending_.empty() && (exports_.wanted() || !pending_.front().analysis->is_searching()))
      finish_first();
  }

  void finish_all_but(std::size_t count) {
    while (pending_.size() > count) finish_first();
  }

  // Of a run that is interrupted: analyses that only have to be written.
  void keep_what_is_ready() {
    stopping_ = true;
    while (!pending_.empty()) {
      if (pending_.front().analysis->is_searching() || pending_.front().analysis->has_failed())
        pending_.pop_front();
      else
        finish_first();
    }
  }

  void finish_first() {
    Pending done = std::move(pending_.front());
    pending_.pop_front();
    pipeline::Outcome outcome = timed(done.work, [&] { return pipeline_.finish(std::move(done.analysis)); });
    const std::chrono::duration<double> seconds = done.work;
    progress_.aside([&] {
      log_outcome(request_.assets[done.asset], outcome, seconds.count());
      all_good_ = exports_.log() && all_good_;
    });
    all_good_ = all_good_ && outcome.analysis && !is_beyond_a_limit(*outcome.analysis);
    analyses_[done.asset] = std::move(outcome.analysis);
    errors_[done.asset] = std::move(outcome.error);
    kept_[done.asset] = outcome.kept;
    close(done.asset, done.asset);
  }

  // Asset `asset` has the results of `first`.
  void close(std::size_t asset, std::size_t first) {
    if (analyses_[first]) rows_ += analyses_[first]->instances.size();
    progress_.finish_asset(asset);
    note_asset_done(kept_[first]);
  }

  Analyses collect(const std::vector<std::size_t>& first_of) {
    Analyses result{.assets = {}, .failed = {}, .all_good = all_good_};
    for (std::size_t i = first_of.size(); i-- > 0;) {
      auto& analysis = analyses_[first_of[i]];
      if (!analysis) {
        result.failed.push_back({request_.assets[i], errors_[first_of[i]]});
        continue;
      }
      // The last to be taken, which is the first, needs no copy.
      result.assets.push_back(first_of[i] == i ? std::move(*analysis) : *analysis);
      result.assets.back().asset = request_.assets[i];
    }
    std::ranges::reverse(result.assets);
    std::ranges::reverse(result.failed);
    return result;
  }

  const AnalyzeRequest& request_;
  Exports exports_;
  pipeline::Pipeline pipeline_;
  Progress progress_;
  std::vector<std::optional<analysis::AssetAnalysis>> analyses_;  // of failed and repeated ones: none
  std::vector<std::string> errors_;                               // of failed ones
  std::vector<bool> kept_;                                        // in an analysis file
  std::size_t rows_ =
      0;  // of the report before the next asset; only right where exports make all go one by one
  bool all_good_ = true;
  bool stopping_ = false;
  std::deque<Pending> pending_;  // in the order given, two at most; last: they end before the pipeline
};

}  // namespace

Analyses analyze_assets(const AnalyzeRequest& request, LazyDevice& device) {
  if (measuring_is_likely(request)) device.start();
  return AssetLoop(request, device).run();
}

}  // namespace scene_analyzer::cli
