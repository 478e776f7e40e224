#include "service/job.h"

#include <algorithm>
#include <utility>

namespace scene_analyzer::service {

Job::Job(Order order) : order_(std::move(order)) {
  auto options = std::make_shared<pipeline::Options>(order_.options);
  options->import_limits.stop = stop_.get_token();
  options_ = std::move(options);
}

void Job::cancel() {
  stop_.request_stop();
}

Job::State Job::wait(std::uint64_t seen, std::chrono::steady_clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return state_.version != seen; });
  return state_;
}

Answer Job::take_answer() {
  const std::lock_guard lock(mutex_);
  return std::move(answer_);
}

void Job::report(double fraction, const std::string& step) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.done) return;
    state_.fraction = std::max(state_.fraction, fraction);
    state_.step = step;
    ++state_.version;
  }
  changed_.notify_all();
}

void Job::finish(Answer answer) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.done) return;
    answer_ = std::move(answer);
    state_.done = true;
    if (!answer_.refusal) state_.fraction = 1;
    ++state_.version;
  }
  changed_.notify_all();
}

void Job::refuse(Reason reason, const std::string& what) {
  Answer answer;
  answer.refusal.emplace(reason, what);
  finish(std::move(answer));
}

bool Job::is_done() const {
  const std::lock_guard lock(mutex_);
  return state_.done;
}

}  // namespace scene_analyzer::service
