#include "viewer/frame_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace scene_analyzer::viewer {
namespace {

constexpr std::size_t kMostKept = 100'000;

}  // namespace

void FrameTimes::shown(double seconds, bool at_once) {
  if (at_once && before_) {
    last_ = seconds - *before_;
    if (times_.size() < kMostKept) times_.push_back(0);
    times_[count_++ % kMostKept] = static_cast<float>(last_);
  }
  before_ = seconds;
}

std::optional<std::string> FrameTimes::summary() const {
  if (times_.empty()) return std::nullopt;
  std::vector<float> sorted = times_;
  std::ranges::sort(sorted);
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  const auto within = [&](double share) {
    return 1000 * sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  return fmt::format(
      "{} pictures in motion: {:.1f} per second, half of them within {:.1f} ms, 95 % within {:.1f} ms",
      count_, static_cast<double>(sorted.size()) / std::max(sum, 1e-9), within(0.5), within(0.95));
}

}  // namespace scene_analyzer::viewer
