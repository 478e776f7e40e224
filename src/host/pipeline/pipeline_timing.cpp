// pipeline_timing.cpp — The Pipeline's rendering times: under which conditions, when, and what is kept.
#include <fmt/format.h>

#include <algorithm>

#include "gpu/error.h"
#include "pipeline/messages.h"
#include "pipeline/pending_analysis.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::pipeline {

using analysis::AssetAnalysis;

bool Pipeline::is_timed_alone(const Options& options) const {
  const std::lock_guard lock(device_mutex_);
  return options.metrics[index_of(analysis::Metric::kRenderingTime)] && known_device_ &&
         known_device_->info.type != gpu::DeviceType::kDiscrete;
}

analysis::RenderTiming::Conditions Pipeline::timing_conditions(const Options& options) {
  return {.device = options.this_device_only ? start_device()->stamp : analysis::DeviceStamp(),
          .width = options.timing_width,
          .height = options.timing_height,
          .steps = options.parameters.steps};
}

bool Pipeline::can_time(Outcome& outcome) {
  const std::string reason = render_timing::why_not(start_device()->info);
  if (!reason.empty()) outcome.messages.push_back("rendering time is not measured: " + reason);
  return reason.empty();
}

// What was stored under other conditions is not what was asked for.
void Pipeline::keep_wanted_timings(const Options& options, AssetAnalysis& analysis) {
  std::erase_if(analysis.timings, [&](const analysis::RenderTiming& timing) {
    return !options.metrics[index_of(analysis::Metric::kRenderingTime)] ||
           !is_under(timing, timing_conditions(options));
  });
}

void Pipeline::time(PendingAnalysis& pending) {
  if (!can_time(pending.outcome_)) return;
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  const Options& options = *pending.options_;
  analysis::RenderTiming::Conditions conditions = timing_conditions(options);
  const auto device = start_device();
  conditions.device = device->stamp;
  const auto progress = [&](double fraction) {
    pending.report(kTimingBegins + (kTimingEnds - kTimingBegins) * fraction, "rendering time");
  };
  progress(0);
  try {
    if (!render_timer_) render_timer_ = std::make_unique<render_timing::RenderTimer>(*gpu_);
    analysis::RenderTiming timing = time_scene(*render_timer_, pending.scene_, analysis, pending.degenerate_,
                                               conditions, options.timing_budget, progress);
    timing.timestamp_period_ns = device->info.timestamp_period_ns;
    timing.budget_seconds = options.timing_budget;
    describe_missing_times(analysis.asset, timing, pending.outcome_.messages);
    put_first(analysis.timings, std::move(timing));
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const gpu::Error& error) {
    pending.outcome_.messages.push_back(
        fmt::format("{}: rendering time is not measured: {}", analysis.asset, error.what()));
  }
}

}  // namespace scene_analyzer::pipeline
