#include "rpc/followed_job.h"

#include <chrono>
#include <optional>
#include <utility>

namespace scene_analyzer::rpc {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kBetweenReports = 100ms;
constexpr auto kBetweenLooks = 20ms;  // at whether the client still waits

// Whoever leaves before the answer is there waits no more.
class Cancelling {
 public:
  Cancelling(service::Executor& executor, const std::shared_ptr<service::Job>& job)
      : executor_(executor), job_(job) {}
  ~Cancelling() { executor_.cancel(job_); }
  Cancelling(const Cancelling&) = delete;
  Cancelling& operator=(const Cancelling&) = delete;

 private:
  service::Executor& executor_;
  const std::shared_ptr<service::Job>& job_;
};

}  // namespace

service::Answer follow_job(Call& call, service::Executor& executor, service::Order order,
                           const std::function<void(const v1::Progress&)>& send) {
  const std::shared_ptr<service::Job> job = executor.submit(std::move(order));
  const Cancelling cancelling(executor, job);
  std::optional<std::uint64_t> sent;  // the version
  Clock::time_point next_report = Clock::now() + kBetweenReports;
  for (service::Job::State state = job->wait(0, Clock::now() + kBetweenLooks); !state.done;) {
    call.check_cancelled();
    if (state.version != sent && Clock::now() >= next_report) {
      v1::Progress progress;
      progress.set_fraction(state.fraction);
      progress.set_step(state.step);
      send(progress);
      sent = state.version;
      next_report = Clock::now() + kBetweenReports;
    }
    state = job->wait(state.version, Clock::now() + kBetweenLooks);
  }
  service::Answer answer = job->take_answer();
  if (answer.refusal) throw service::Refusal(*answer.refusal);
  return answer;
}

}  // namespace scene_analyzer::rpc
