#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/logging.h"
#include "cli/terminal.h"

namespace scene_analyzer::cli {
namespace {

using namespace std::chrono_literals;
constexpr auto kBarInterval = 200ms;
constexpr auto kLineInterval = 5s;
constexpr std::size_t kBarCells = 24;
constexpr const char* kWipeLine = "\r\x1b[K";

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
  if (width == 0 || text.size() <= width) return text;
  text.resize(width);
  // Not in the middle of a UTF-8 character.
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xc0) text.pop_back();
  return text;
}

std::string progress_line(const ProgressState& state) {
  return fmt::format("progress: {}%, asset {} of {}, {}: {}", percent(state), state.asset + 1, state.assets,
                     one_line(state.name), one_line(state.step));
}

Progress::Progress(bool enabled, std::size_t assets, std::chrono::milliseconds silence)
    : bar_(is_terminal(STDERR_FILENO)), silence_(silence), assets_(assets) {
  state_.assets = assets;
  if (enabled) thread_ = std::jthread([this](const std::stop_token& stop) { draw_until_stopped(stop); });
}

Progress::~Progress() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  wipe();
}

void Progress::start_asset(std::size_t asset, const std::string& name) {
  const std::lock_guard lock(mutex_);
  assets_.at(asset).name = name;
  state_.asset = asset;
  state_.name = name;
  state_.step.clear();
}

void Progress::update(std::size_t asset, double fraction, const std::string& step) {
  const std::lock_guard lock(mutex_);
  raise(asset, fraction);
  state_.asset = asset;
  state_.name = assets_[asset].name;
  state_.step = step;
}

void Progress::finish_asset(std::size_t asset) {
  const std::lock_guard lock(mutex_);
  raise(asset, 1);
}

void Progress::raise(std::size_t asset, double fraction) {
  const double more = std::max(0.0, std::clamp(fraction, 0.0, 1.0) - assets_.at(asset).done);
  assets_[asset].done += more;
  state_.done += more;
}

void Progress::aside(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  wipe();
  print();
}

void Progress::draw_until_stopped(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  auto wait = silence_;
  // The predicate is only true on stop: the wait is a pause that a stop cuts short.
  while (!changed_.wait_for(lock, stop, wait, [&] { return stop.stop_requested(); })) {
    if (bar_) {
      // One column is left free: some terminals wrap when the last one is written.
      const std::size_t width = terminal_width(STDERR_FILENO);
      fmt::print(stderr, "{}{}", kWipeLine, progress_bar(state_, width > 1 ? width - 1 : 0));
      std::fflush(stderr);
      drawn_ = true;
      wait = kBarInterval;
    } else {
      fmt::print(stderr, "{}\n", progress_line(state_));
      wait = kLineInterval;
    }
  }
}

void Progress::wipe() {
  if (!drawn_) return;
  fmt::print(stderr, "{}", kWipeLine);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace scene_analyzer::cli
