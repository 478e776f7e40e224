#include "service/executor.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "gpu/error.h"
#include "import/import.h"
#include "pipeline/pending_analysis.h"

namespace scene_analyzer::service {
namespace {

using namespace std::chrono_literals;

// What goes to the device together: enough to make its fixed costs small.
constexpr std::size_t kMostTogether = 64;
constexpr std::uint64_t kMostTriangles = 500'000;
// Packs whose start triangles are searched at the same time. Each has threads on all processors.
constexpr std::size_t kMostPending = 4;
constexpr auto kLongestWait = 25ms;  // for more of it, while there are imports
constexpr auto kBetweenLooks = 2ms;  // at searches

bool wants_times(const Job& job) {
  return job.options()->metrics[index_of(analysis::Metric::kRenderingTime)];
}

bool goes_alone(const Imported& one) {
  return one.job->is_alone() || one.job->order().picture || wants_times(*one.job);
}

bool can_go_together(const Imported& one, const Imported& other) {
  return !goes_alone(other) && one.job->options()->parameters == other.job->options()->parameters &&
         one.job->options()->metrics == other.job->options()->metrics;
}

}  // namespace

Executor::Executor(const ExecutorOptions& options, std::function<gpu::Device&()> device, Metrics& metrics,
                   std::function<void(const std::string&)> log_error)
    : options_(options),
      metrics_(metrics),
      log_error_(std::move(log_error)),
      pipeline_({}, std::move(device)),
      worker_(pipeline_, metrics,
              {.try_again = [this](std::shared_ptr<Job> job) { enqueue(std::move(job), true); },
               .released =
                   [this](std::uint64_t bytes) {
                     {
                       const std::lock_guard lock(mutex_);
                       held_bytes_ -= bytes;
                     }
                     changed_.notify_all();
                   },
               .error = log_error_}) {
  for (unsigned i = 0; i < std::max(1U, options_.import_workers); ++i)
    threads_.emplace_back([this] { run_imports(); });
  threads_.emplace_back([this] { run_device(); });
}

Executor::~Executor() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& job : importing_jobs_) job->cancel();  // which ends its worker
  }
  changed_.notify_all();
  threads_.clear();
  constexpr const char* kWhy = "the service is shutting down";
  for (const auto& job : waiting_) job->refuse(Reason::kUnavailable, kWhy);
  for (const Imported& one : ready_) one.job->refuse(Reason::kUnavailable, kWhy);
}

std::shared_ptr<Job> Executor::submit(Order order) {
  auto job = std::make_shared<Job>(std::move(order));
  enqueue(job, false);
  return job;
}

void Executor::enqueue(std::shared_ptr<Job> job, bool first) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) {
      job->refuse(Reason::kUnavailable, "the service is shutting down");
      return;
    }
    waiting_.insert(first ? waiting_.begin() : waiting_.end(), std::move(job));
  }
  changed_.notify_all();
}

Executor::Depth Executor::depth() const {
  const std::lock_guard lock(mutex_);
  return {waiting_.size(), ready_.size()};
}

analysis::DeviceStamp Executor::device() {
  return pipeline_.device_stamp();
}

std::shared_ptr<Job> Executor::next_to_import() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    return stopping_ || (!waiting_.empty() && !paused_ && held_bytes_ < options_.most_bytes);
  });
  if (stopping_) return nullptr;
  ++importing_;
  std::shared_ptr<Job> job = std::move(waiting_.front());
  waiting_.pop_front();
  importing_jobs_.insert(job);
  return job;
}

void Executor::run_imports() {
  while (const auto job = next_to_import()) {
    std::optional<Imported> imported = prepare(job);
    {
      const std::lock_guard lock(mutex_);
      --importing_;
      importing_jobs_.erase(job);
      if (imported) {
        held_bytes_ += imported->bytes;
        ready_.push_back(std::move(*imported));
      }
    }
    changed_.notify_all();
  }
}

// Nothing when the job has its answer.
std::optional<Imported> Executor::prepare(const std::shared_ptr<Job>& job) {
  const auto progress = [this, job = job.get()](double fraction, const std::string& step) {
    job->report(fraction, step);
    if (job->is_given_up() || stopping_) throw GivenUp();
  };
  try {
    Imported imported{.job = job, .analysis = nullptr, .picture = {}};
    imported.analysis = pipeline_.prepare(job->order().asset, progress, job->options());
    if (imported.analysis->has_failed() ||
        !(job->order().picture || imported.analysis->has_something_to_measure())) {
      answer_without_device(job, std::move(imported.analysis));
      return std::nullopt;
    }
    if (job->order().picture)
      imported.picture =
          import::import_asset(job->order().asset, job->options()->import_limits, import::Textures::kDecode);
    imported.bytes = imported.analysis->held_bytes() + imported.picture.effort.answer_bytes;
    return imported;
  } catch (const GivenUp& error) {
    job->refuse(Reason::kCancelled, error.what());
  } catch (const import::Stopped& error) {
    job->refuse(Reason::kCancelled, error.what());
  } catch (const InputError& error) {
    job->refuse(Reason::kInvalid, error.what());
  } catch (const gpu::Error& error) {
    log(error.what());
    job->refuse(Reason::kUnavailable, error.what());
  } catch (const std::exception& error) {
    log(error.what());
    job->refuse(Reason::kInternal, "a defect of the service; its log says more");
  }
  return std::nullopt;
}

void Executor::answer_without_device(const std::shared_ptr<Job>& job,
                                     std::unique_ptr<pipeline::PendingAnalysis> analysis) {
  pipeline::Outcome outcome = pipeline_.finish(std::move(analysis));
  if (!outcome.error.empty() && outcome.may_succeed_alone && job->try_alone()) return enqueue(job, true);
  job->finish(answer_of(std::move(outcome), metrics_));
}

// Waits until something is ready, or what is pending on the device wants to be looked at: then none. Nothing
// at all when the executor ends.
std::vector<Imported> Executor::take_pack() {
  std::vector<Imported> pack;
  std::unique_lock lock(mutex_);
  const auto awake = [&] { return stopping_ || (!ready_.empty() && worker_.pending() < kMostPending); };
  if (worker_.pending() == 0)
    changed_.wait(lock, awake);
  else
    changed_.wait_for(lock, kBetweenLooks, awake);
  if (stopping_ || ready_.empty() || worker_.pending() >= kMostPending) return pack;
  if (!goes_alone(ready_.front())) {
    // What comes soon is measured with it for next to nothing.
    const auto is_enough = [&] {
      return stopping_ || ready_.size() >= kMostTogether || (importing_ == 0 && waiting_.empty());
    };
    changed_.wait_for(lock, kLongestWait, is_enough);
  }
  std::uint64_t triangles = 0;
  const auto take = [&](const std::deque<Imported>::iterator& one) {
    triangles += one->analysis->triangles();
    pack.push_back(std::move(*one));
    return ready_.erase(one);
  };
  take(ready_.begin());
  if (goes_alone(pack.front())) return pack;
  for (auto next = ready_.begin();
       next != ready_.end() && pack.size() < kMostTogether && triangles < kMostTriangles;)
    next = can_go_together(pack.front(), *next) ? take(next) : next + 1;
  return pack;
}

void Executor::run_device() {
  while (true) {
    worker_.finish_searched();
    std::vector<Imported> pack = take_pack();
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) {
        std::ranges::move(pack, std::back_inserter(ready_));  // to be refused with the others
        break;
      }
    }
    if (pack.empty()) continue;
    if (wants_times(*pack.front().job))
      measure_alone(std::move(pack));
    else
      worker_.start(std::move(pack));
  }
}

// With nothing beside it that could slow it down.
void Executor::measure_alone(std::vector<Imported> pack) {
  worker_.finish_all();
  bool pause = true;  // also where nobody knows the device yet
  try {
    pipeline_.device();
    pause = pipeline_.is_timed_alone(*pack.front().job->options());
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): start() meets it again and answers
  }
  if (pause) {
    std::unique_lock lock(mutex_);
    paused_ = true;
    changed_.wait(lock, [&] { return importing_ == 0 || stopping_; });
  }
  worker_.start(std::move(pack));
  worker_.finish_all();
  {
    const std::lock_guard lock(mutex_);
    paused_ = false;
  }
  changed_.notify_all();
}

}  // namespace scene_analyzer::service
