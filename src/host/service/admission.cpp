#include "service/admission.h"

#include <fmt/format.h>

#include <algorithm>

#include "service/refusal.h"

namespace scene_analyzer::service {
namespace {

using std::chrono::milliseconds;

constexpr double kShareOfNewest = 0.1;  // in the mean
constexpr milliseconds kShortestWait(100), kLongestWait(30'000);

}  // namespace

Admission::Ticket Admission::admit() {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Refusal(Reason::kUnavailable, "the service is shutting down; try another one, or later");
  if (admitted_ >= most_) {
    // Places become free `most` times within the time that a request takes. Whoever was refused before comes
    // first, so that not all come back at once.
    const double seconds = static_cast<double>(++refused_) * mean_seconds_ / static_cast<double>(most_);
    const milliseconds wait =
        std::clamp(milliseconds(static_cast<long>(seconds * 1000)), kShortestWait, kLongestWait);
    throw Refusal(
        Reason::kBusy,
        fmt::format("{} requests are being worked on, as many as this service takes (--queue); try again in "
                    "{} ms",
                    admitted_, wait.count()),
        wait);
  }
  ++admitted_;
  return Ticket(*this);
}

void Admission::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

bool Admission::wait_until_empty(std::chrono::steady_clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  return left_.wait_until(lock, deadline, [&] { return admitted_ == 0; });
}

std::size_t Admission::admitted() const {
  const std::lock_guard lock(mutex_);
  return admitted_;
}

void Admission::leave(std::chrono::steady_clock::duration taken) {
  {
    const std::lock_guard lock(mutex_);
    --admitted_;
    refused_ = 0;
    mean_seconds_ += kShareOfNewest * (std::chrono::duration<double>(taken).count() - mean_seconds_);
  }
  left_.notify_all();
}

}  // namespace scene_analyzer::service
