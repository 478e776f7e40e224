// pipeline_timing.cpp — The Pipeline's rendering times: under which conditions, when, and what is kept.
#include <fmt/format.h>

#include <algorithm>

#include "gpu/error.h"
#include "pipeline/messages.h"
#include "pipeline/pending_analysis.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::pipeline {

using analysis::AssetAnalysis;

bool Pipeline::is_timed_alone() const {
  const std::lock_guard lock(device_mutex_);
  return options_.metrics[index_of(analysis::Metric::kRenderingTime)] && known_device_ &&
         known_device_->info.type != gpu::DeviceType::kDiscrete;
}

analysis::RenderTiming::Conditions Pipeline::timing_conditions() {
  return {.device = options_.this_device_only ? start_device()->stamp : analysis::DeviceStamp(),
          .width = options_.timing_width,
          .height = options_.timing_height,
          .steps = options_.parameters.steps};
}

bool Pipeline::can_time(Outcome& outcome) {
  const std::string reason = render_timing::why_not(start_device()->info);
  if (!reason.empty()) outcome.messages.push_back("rendering time is not measured: " + reason);
  return reason.empty();
}

// What was stored under other conditions is not what was asked for.
void Pipeline::keep_wanted_timings(AssetAnalysis& analysis) {
  std::erase_if(analysis.timings, [&](const analysis::RenderTiming& timing) {
    return !options_.metrics[index_of(analysis::Metric::kRenderingTime)] ||
           !is_under(timing, timing_conditions());
  });
}

void Pipeline::time(PendingAnalysis& pending) {
  if (!can_time(pending.outcome_)) return;
  AssetAnalysis& analysis = *pending.outcome_.analysis;
  analysis::RenderTiming::Conditions conditions = timing_conditions();
  const auto device = start_device();
  conditions.device = device->stamp;
  const auto progress = [&](double fraction) {
    pending.report(kTimingBegins + (kTimingEnds - kTimingBegins) * fraction, "rendering time");
  };
  progress(0);
  try {
    if (!render_timer_) render_timer_ = std::make_unique<render_timing::RenderTimer>(*gpu_);
    analysis::RenderTiming timing = time_scene(*render_timer_, pending.scene_, analysis, pending.degenerate_,
                                               conditions, options_.timing_budget, progress);
    timing.timestamp_period_ns = device->info.timestamp_period_ns;
    timing.budget_seconds = options_.timing_budget;
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
