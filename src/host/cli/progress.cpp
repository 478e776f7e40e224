#include "cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/logging.h"

namespace scene_analyzer::cli {
namespace {

constexpr std::size_t kBarCells = 24;

double overall(const ProgressState& state) {
  const double assets = static_cast<double>(std::max<std::size_t>(state.assets, 1));
  return std::clamp(state.done / assets, 0.0, 1.0);
}

int percent(const ProgressState& state) {
  return static_cast<int>(overall(state) * 100);
}

}  // namespace

std::string progress_bar(const ProgressState& state, std::size_t width) {
  const auto filled = static_cast<std::size_t>(overall(state) * kBarCells);
  std::string text = fmt::format("{:3}% [{}{}] {}/{} {}: {}", percent(state), std::string(filled, '#'),
                                 std::string(kBarCells - filled, ' '), state.asset + 1, state.assets,
                                 one_line(state.name), one_line(state.step));
  return fitted(std::move(text), width);
}

std::string progress_line(const ProgressState& state) {
  return fmt::format("progress: {}%, asset {} of {}, {}: {}", percent(state), state.asset + 1, state.assets,
                     one_line(state.name), one_line(state.step));
}

Progress::Progress(bool enabled, std::size_t assets, std::chrono::milliseconds silence)
    : assets_(assets),
      status_(enabled,
              {.bar = [this](std::size_t width) { return progress_bar(state_, width); },
               .line = [this] { return progress_line(state_); }},
              silence) {
  const std::lock_guard lock(status_.mutex());
  state_.assets = assets;
}

void Progress::start_asset(std::size_t asset, const std::string& name) {
  const std::lock_guard lock(status_.mutex());
  assets_.at(asset).name = name;
  state_.asset = asset;
  state_.name = name;
  state_.step.clear();
}

void Progress::update(std::size_t asset, double fraction, const std::string& step) {
  const std::lock_guard lock(status_.mutex());
  raise(asset, fraction);
  state_.asset = asset;
  state_.name = assets_[asset].name;
  state_.step = step;
}

void Progress::finish_asset(std::size_t asset) {
  const std::lock_guard lock(status_.mutex());
  raise(asset, 1);
}

void Progress::raise(std::size_t asset, double fraction) {
  const double more = std::max(0.0, std::clamp(fraction, 0.0, 1.0) - assets_.at(asset).done);
  assets_[asset].done += more;
  state_.done += more;
}

}  // namespace scene_analyzer::cli
