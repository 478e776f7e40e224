#include "cli/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/version.h"
#include "cli/analyze_assets.h"
#include "cli/check_options.h"
#include "cli/check_outputs.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/lazy_device.h"
#include "cli/outputs.h"
#include "cli/run_state.h"
#include "gate/baseline_file.h"
#include "gate/init_budget.h"
#include "gpu/device.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kTiming = index_of(analysis::Metric::kRenderingTime);

// Reasons mostly begin with the asset's name, which outputs put beside them.
std::string without_name(std::string_view reason, const std::string& asset) {
  const std::string prefix = asset + ": ";
  if (reason.starts_with(prefix)) reason.remove_prefix(prefix.size());
  return std::string(reason);
}

class Check {
 public:
  explicit Check(CheckRequest& request) : request_(request), device_(device_options(request.device)) {
    if (request.budget) budget_ = gate::read_budget(*request.budget);
    options_.strict = request.strict;
    options_.allow_cpu_timing = request.allow_cpu_timing;
  }

  int run() {
    choose_metrics();
    if (request_.baseline) read_baselines();
    analyze();
    for (const std::string& message : validation_) log_error(message);
    if (!validation_.empty()) return kUnusable;  // wrong use of the device makes every figure doubtful
    Outputs outputs;
    if (request_.write_baseline) outputs.attempt([&] { write_baselines(); });
    if (request_.init) outputs.attempt([&] { write_init(); });
    const bool failed = budget_ && judge(outputs);
    const bool written = outputs.are_good();
    if (written) note_report_written();
    if (failed) return kGateFailed;
    return written && all_good_ ? kSuccess : kInputFailed;
  }

 private:
  // What the budget needs, and what was asked for by name. Times of a CPU device are not worth their time.
  void choose_metrics() {
    analysis::MetricSet metrics;
    if (budget_) metrics = gate::needed_metrics(*budget_);
    if (request_.choose_metrics)
      metrics |= request_.pipeline.metrics;
    else if (!budget_)
      metrics.set().reset(kTiming);
    if (metrics[kTiming] && !request_.allow_cpu_timing) {
      const gpu::DeviceInfo& info = device_.get().info();
      if (info.type == gpu::DeviceType::kCpu) {
        options_.cpu_device = info.name;
        metrics.reset(kTiming);
        log_note(fmt::format(
            "rendering times are not measured: {} is a CPU device; --allow-cpu-timing measures them",
            info.name));
      }
    }
    request_.pipeline.metrics = metrics;
  }

  void read_baselines() {
    for (const std::string& asset : request_.assets) {
      const std::string path = path_of(asset);
      if (auto baseline = gate::read_baseline(*request_.baseline, path)) {
        if (baseline->tool_version != version() && !std::exchange(said_version_, true))
          log_warning(fmt::format("the baseline of {} was written by scene-analyzer {}, this is {}", path,
                                  baseline->tool_version, version()));
        baselines_.emplace(path, std::move(*baseline));
      }
    }
    if (baselines_.empty())
      log_warning(
          fmt::format("{} has none of the assets; all are judged by the limits alone. A baseline "
                      "belongs to the folder that the command is started in",
                      request_.baseline->string()));
    options_.baselines = &baselines_;
  }

  std::string path_of(const std::string& asset) const { return gate::portable_path(asset, folder_); }

  void analyze() {
    AnalyzeRequest request;
    request.assets = request_.assets;
    request.pipeline = request_.pipeline;
    request.log = request_.log;
    Analyses analyses = analyze_assets(request, device_);
    all_good_ = analyses.all_good;
    validation_ = device_.take_validation_messages();
    const gate::Weights weights = budget_ ? budget_->weights : gate::kDefaultWeights;
    // Both lists are in the order of the assets.
    auto good = analyses.assets.begin();
    auto bad = analyses.failed.begin();
    for (const std::string& asset : request_.assets)
      if (good != analyses.assets.end() && good->asset == asset) {
        states_.push_back(gate::state_of(path_of(asset), std::move(*good++), request_.pipeline.metrics,
                                         weights, budget_ ? budget_->eye : std::nullopt));
      } else {
        gate::AssetState& state = states_.emplace_back();
        state.path = path_of(asset);
        state.failure = without_name((bad++)->reason, asset);
      }
    if (request_.baseline) require_comparable();
  }

  gate::AssetBaseline baseline_now(const gate::AssetState& state) const {
    return gate::baseline_of(state, budget_ ? budget_->weights : gate::kDefaultWeights,
                             budget_ ? budget_->eye : std::nullopt);
  }

  void require_comparable() const {
    for (const gate::AssetState& state : states_)
      if (const auto before = baselines_.find(state.path);
          before != baselines_.end() && state.failure.empty())
        gate::require_comparable(before->second, baseline_now(state));
  }

  void write_baselines() {
    for (const gate::AssetState& state : states_) {
      check_interrupt();
      if (!state.failure.empty()) continue;
      gate::AssetBaseline baseline = baseline_now(state);
      gate::write_baseline(*request_.write_baseline, baseline);
      baselines_.insert_or_assign(state.path, std::move(baseline));
    }
    options_.baselines = &baselines_;
    log_note(fmt::format("{}: baseline of {} assets", request_.write_baseline->string(), baselines_.size()));
  }

  void write_init() const {
    if (std::ranges::all_of(states_, [](const auto& state) { return !state.failure.empty(); }))
      throw InputError(fmt::format("{} is not written: no asset could be analysed", request_.init->string()));
    report::write_file(*request_.init, gate::init_budget(states_));
    if (*request_.init != "-") log_note(fmt::format("{} is written", request_.init->string()));
  }

  // Whether the gate failed.
  bool judge(Outputs& outputs) {
    const gate::CheckResult result = gate::evaluate(*budget_, states_, options_);
    const gate::CheckReport report{.budget = *budget_,
                                   .assets = states_,
                                   .result = result,
                                   .baseline = request_.baseline ? request_.baseline->string() : "",
                                   .strict = request_.strict};
    write_check(request_, report, outputs);
    return result.failed;
  }

  CheckRequest& request_;
  LazyDevice device_;
  const fs::path folder_ = fs::current_path();
  std::optional<gate::Budget> budget_;
  gate::CheckOptions options_;
  gate::Baselines baselines_;
  std::vector<gate::AssetState> states_;
  std::vector<std::string> validation_;
  bool all_good_ = true, said_version_ = false;
};

}  // namespace

int check_command(std::span<const std::string> arguments) {
  CheckRequest request = parse_check(arguments);
  if (request.help) {
    report::write_file("-", check_help());
    return kSuccess;
  }
  set_up_logging(request.log);
  watch_interrupts();
  request.pipeline.import_limits.stop = interrupt_token();
  return Check(request).run();
}

}  // namespace scene_analyzer::cli
