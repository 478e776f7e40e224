#include "cli/library_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/logging.h"

namespace scene_analyzer::cli {
namespace {

constexpr std::size_t kBarCells = 24;
constexpr auto kBetweenMarks = std::chrono::seconds(10);

double fraction(const LibraryState& state) {
  return state.assets == 0 ? 1 : static_cast<double>(state.done) / static_cast<double>(state.assets);
}

// ", 1310/min, 53 s left, 3 not analysed"; what is not known yet is left out.
std::string figures(const LibraryState& state) {
  std::string text;
  if (state.per_second > 0)
    text += fmt::format(", {:.0f}/min, {} left", state.per_second * 60,
                        duration_text(static_cast<double>(state.assets - state.done) / state.per_second));
  if (state.failed > 0) text += fmt::format(", {} not analysed", state.failed);
  return text;
}

}  // namespace

double RecentRate::per_second(Time now, std::uint64_t done) {
  if (now - latest_.time >= kBetweenMarks) former_ = std::exchange(latest_, {now, done});
  const std::chrono::duration<double> seconds = now - former_.time;
  return seconds.count() > 0 ? static_cast<double>(done - former_.done) / seconds.count() : 0;
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string library_bar(const LibraryState& state, std::size_t width) {
  const auto filled = static_cast<std::size_t>(fraction(state) * kBarCells);
  return fitted(fmt::format("{:3.0f}% [{}{}] {}/{} assets{}: {}", std::floor(fraction(state) * 100),
                            std::string(filled, '#'), std::string(kBarCells - filled, ' '), state.done,
                            state.assets, figures(state), one_line(state.name)),
                width);
}

std::string library_line(const LibraryState& state) {
  return fmt::format("progress: {:.0f}%, {} of {} assets{}", std::floor(fraction(state) * 100), state.done,
                     state.assets, figures(state));
}

LibraryProgress::LibraryProgress(bool enabled, std::uint64_t assets)
    : status_(enabled, {.bar = [this](std::size_t width) { return library_bar(now(), width); },
                        .line = [this] { return library_line(now()); }}) {
  const std::lock_guard lock(status_.mutex());
  state_.assets = assets;
}

void LibraryProgress::finish_asset(const std::string& name, bool analysed) {
  const std::lock_guard lock(status_.mutex());
  ++state_.done;
  if (!analysed) ++state_.failed;
  state_.name = name;
}

LibraryState LibraryProgress::now() {
  state_.per_second = rate_.per_second(std::chrono::steady_clock::now(), state_.done);
  return state_;
}

MergeStatus::MergeStatus(bool enabled)
    : status_(enabled, {.bar = [this](std::size_t width) { return fitted(text(), width); },
                        .line = [this] { return "progress: " + text(); }}) {}

void MergeStatus::update(std::uint64_t done, std::uint64_t assets) {
  const std::lock_guard lock(status_.mutex());
  done_ = done;
  assets_ = assets;
}

std::string MergeStatus::text() const {
  return fmt::format("reading analyses: {} of {}", done_, assets_);
}

}  // namespace scene_analyzer::cli
