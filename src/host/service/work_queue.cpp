#include "service/work_queue.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "pipeline/pending_analysis.h"

namespace scene_analyzer::service {
namespace {

using namespace std::chrono_literals;

// What goes to the device together: enough to make its fixed costs small.
constexpr std::size_t kMostTogether = 64;
constexpr std::uint64_t kMostTriangles = 500'000;
// Packs whose start triangles are searched at the same time. Each has threads on all processors.
constexpr std::size_t kMostPending = 4;
constexpr auto kLongestGathering = 25ms;  // for more of it, while there are imports
constexpr auto kBetweenLooks = 2ms;       // at searches, and at whether somebody waits for a timing

bool goes_alone(const Imported& one) {
  return one.job->is_alone() || one.job->order().picture || wants_times(*one.job);
}

bool can_go_together(const Imported& one, const Imported& other) {
  return !goes_alone(other) && one.job->options()->parameters == other.job->options()->parameters &&
         one.job->options()->metrics == other.job->options()->metrics;
}

}  // namespace

bool wants_times(const Job& job) {
  return job.options()->metrics[index_of(analysis::Metric::kRenderingTime)];
}

void WorkQueue::add(std::shared_ptr<Job> job, bool first) {
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return job->refuse(Reason::kUnavailable, kShuttingDown);
    if (job->is_cancelled()) return job->refuse(Reason::kCancelled, GivenUp().what());
    waiting_.insert(first ? waiting_.begin() : waiting_.end(), std::move(job));
  }
  changed_.notify_all();
}

void WorkQueue::release(std::uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    held_bytes_ -= bytes;
  }
  changed_.notify_all();
}

void WorkQueue::cancel(const std::shared_ptr<Job>& job) {
  job->cancel();
  std::optional<Imported> dropped;  // its memory is given back after the lock
  {
    const std::lock_guard lock(mutex_);
    const auto ready = std::ranges::find(ready_, job, &Imported::job);
    if (ready != ready_.end()) {
      dropped = std::move(*ready);
      ready_.erase(ready);
      held_bytes_ -= dropped->bytes;
      next_ready();  // quiet may be wanted no longer, and the device's thread need not look before long
    } else if (std::erase(waiting_, job) == 0) {
      return;
    }
  }
  job->refuse(Reason::kCancelled, GivenUp().what());
  changed_.notify_all();
}

void WorkQueue::end() {
  std::vector<std::shared_ptr<Job>> jobs;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    jobs.assign(waiting_.begin(), waiting_.end());
    jobs.insert(jobs.end(), importing_.begin(), importing_.end());
    for (const Imported& one : ready_) jobs.push_back(one.job);
  }
  for (const auto& job : jobs) {
    job->refuse(Reason::kUnavailable, kShuttingDown);
    job->cancel();  // nothing is imported for nobody
  }
  changed_.notify_all();
}

bool WorkQueue::has_ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

WorkQueue::Depth WorkQueue::depth() const {
  const std::lock_guard lock(mutex_);
  return {waiting_.size(), ready_.size()};
}

std::shared_ptr<Job> WorkQueue::next_to_import() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    if (ended_) return true;
    if (waiting_.empty() || held_bytes_ >= most_bytes_) return false;
    if (quiet_is_wanted_ || timing_quietly_ || import_is_alone_) return false;
    return importing_.empty() || !waiting_.front()->is_alone();
  });
  if (ended_) return nullptr;
  std::shared_ptr<Job> job = std::move(waiting_.front());
  waiting_.pop_front();
  importing_.insert(job);
  import_is_alone_ = job->is_alone();
  return job;
}

void WorkQueue::imported(const std::shared_ptr<Job>& job, std::optional<Imported> result) {
  {
    const std::lock_guard lock(mutex_);
    importing_.erase(job);
    import_is_alone_ = false;  // nothing else is under way where it was
    if (result && job->is_cancelled()) {
      job->refuse(Reason::kCancelled, GivenUp().what());
    } else if (result && !ended_) {  // else it was refused by end()
      held_bytes_ += result->bytes;
      ready_.push_back(std::move(*result));
    }
  }
  changed_.notify_all();
}

// What may go to the device now. Whatever waits for quiet is passed over, but not what nobody waits for.
std::deque<Imported>::iterator WorkQueue::next_ready() {
  quiet_is_wanted_ = false;
  for (auto one = ready_.begin(); one != ready_.end(); ++one) {
    if (!one->wants_quiet || importing_.empty() || one->job->is_cancelled()) return one;
    quiet_is_wanted_ = true;
  }
  return ready_.end();
}

std::vector<Imported> WorkQueue::take_pack(std::size_t pending) {
  std::unique_lock lock(mutex_);
  auto next = ready_.end();
  const auto is_awake = [&] {
    next = pending < kMostPending ? next_ready() : ready_.end();
    return ended_ || next != ready_.end();
  };
  if (pending == 0 && ready_.empty()) changed_.wait(lock, [&] { return is_awake() || !ready_.empty(); });
  if (!is_awake()) changed_.wait_for(lock, kBetweenLooks, is_awake);
  if (ended_ || next == ready_.end()) return {};
  if (!goes_alone(*next)) {
    // What comes soon is measured with it for next to nothing.
    const auto is_enough = [&] {
      const bool more_comes = !importing_.empty() || (!waiting_.empty() && !quiet_is_wanted_);
      return ended_ || ready_.size() >= kMostTogether || !more_comes;
    };
    changed_.wait_for(lock, kLongestGathering, is_enough);
    if (ended_) return {};
    next = next_ready();
    if (next == ready_.end()) return {};  // it was cancelled
  }
  std::vector<Imported> pack = take(next);
  lock.unlock();
  changed_.notify_all();  // quiet may be wanted no longer
  return pack;
}

std::vector<Imported> WorkQueue::take(const std::deque<Imported>::iterator& first) {
  std::vector<Imported> pack;
  std::uint64_t triangles = 0;
  const auto move = [&](const std::deque<Imported>::iterator& one) {
    triangles += one->analysis->triangles();
    pack.push_back(std::move(*one));
    return ready_.erase(one);
  };
  auto next = move(first);
  timing_quietly_ = pack.front().wants_quiet;
  if (goes_alone(pack.front())) return pack;
  while (next != ready_.end() && pack.size() < kMostTogether && triangles < kMostTriangles)
    next = can_go_together(pack.front(), *next) ? move(next) : next + 1;
  return pack;
}

void WorkQueue::measured() {
  {
    const std::lock_guard lock(mutex_);
    timing_quietly_ = false;
  }
  changed_.notify_all();
}

}  // namespace scene_analyzer::service
