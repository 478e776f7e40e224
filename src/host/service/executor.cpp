#include "service/executor.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "base/error.h"
#include "gpu/error.h"
#include "import/import.h"
#include "pipeline/pending_analysis.h"

namespace scene_analyzer::service {

Executor::Executor(const ExecutorOptions& options, std::function<gpu::Device&()> device, Metrics& metrics,
                   std::function<void(const std::string&)> log_error)
    : metrics_(metrics),
      log_error_(std::move(log_error)),
      pipeline_({}, std::move(device)),
      queue_(options.most_bytes),
      worker_(pipeline_, metrics,
              {.try_again = [this](std::shared_ptr<Job> job) { queue_.add(std::move(job), true); },
               .released = [this](std::uint64_t bytes) { queue_.release(bytes); },
               .error = log_error_}) {
  try {
    for (unsigned i = 0; i < std::max(1U, options.import_workers); ++i)
      threads_.emplace_back([this] { run_imports(); });
    threads_.emplace_back([this] { run_device(); });
  } catch (...) {  // those that were started wait for work
    queue_.end();
    threads_.clear();
    throw;
  }
}

Executor::~Executor() {
  queue_.end();
  threads_.clear();
}

std::shared_ptr<Job> Executor::submit(Order order) {
  auto job = std::make_shared<Job>(std::move(order));
  queue_.add(job);
  return job;
}

analysis::DeviceStamp Executor::device() {
  return pipeline_.device_stamp();
}

void Executor::run_imports() {
  while (const auto job = queue_.next_to_import()) queue_.imported(job, prepare(job));
}

// Nothing when the job has its answer.
std::optional<Imported> Executor::prepare(const std::shared_ptr<Job>& job) {
  try {
    return import(job);
  } catch (const GivenUp& error) {
    job->refuse(Reason::kCancelled, error.what());
  } catch (const import::Stopped& error) {
    job->refuse(Reason::kCancelled, error.what());
  } catch (const Refusal& refusal) {
    job->refuse(refusal.reason(), refusal.what());
  } catch (const import::EndedEarly& error) {
    // While the picture's scene was read; pipeline::Pipeline takes what happens to the analysis.
    try_alone_or_refuse(job, error.what());
  } catch (const std::bad_alloc&) {
    try_alone_or_refuse(job, "the service's machine has too little free memory for this asset");
  } catch (const InputError& error) {
    job->refuse(Reason::kInvalid, error.what());
  } catch (const gpu::Error& error) {
    log(error.what());
    job->refuse(Reason::kUnavailable, error.what());
  } catch (const std::exception& error) {
    log(error.what());
    job->refuse(Reason::kInternal, kDefect);
  }
  return std::nullopt;
}

void Executor::try_alone_or_refuse(const std::shared_ptr<Job>& job, const std::string& what) {
  if (job->try_alone())
    queue_.add(job, true);
  else
    job->refuse(Reason::kTooLarge, what);
}

std::optional<Imported> Executor::import(const std::shared_ptr<Job>& job) {
  const auto progress = [this, job = job.get()](double fraction, const std::string& step) {
    job->report(fraction, step);
    if (job->is_given_up() || queue_.has_ended()) throw GivenUp();
  };
  Imported imported{.job = job, .analysis = nullptr, .picture = {}};
  imported.refused_before = worker_.losses().refused();
  worker_.losses().check(job->order().asset);
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
  imported.wants_quiet = imported.analysis->has_something_to_measure() && wants_quiet(*job);
  return imported;
}

void Executor::answer_without_device(const std::shared_ptr<Job>& job,
                                     std::unique_ptr<pipeline::PendingAnalysis> analysis) {
  pipeline::Outcome outcome = pipeline_.finish(std::move(analysis));
  if (!outcome.error.empty() && outcome.may_succeed_alone && job->try_alone()) return queue_.add(job, true);
  job->finish(answer_of(std::move(outcome), metrics_));
}

// Whether imports beside it would slow the rendering down that it wants to be timed.
bool Executor::wants_quiet(const Job& job) {
  if (!wants_times(job)) return false;
  try {
    pipeline_.device_stamp();
    return pipeline_.is_timed_alone(*job.options());
  } catch (const gpu::Error&) {  // is met again where it is measured, which says so
    return true;
  }
}

void Executor::run_device() {
  while (!queue_.has_ended()) {
    worker_.finish_searched();
    std::vector<Imported> pack = queue_.take_pack(worker_.pending());
    if (pack.empty()) continue;
    const Job& first = *pack.front().job;
    const bool alone = wants_times(first) || first.is_alone();  // with nothing pending beside it
    if (alone) worker_.finish_all();
    worker_.start(std::move(pack));
    if (alone) worker_.finish_all();
    queue_.measured();
  }
}

}  // namespace scene_analyzer::service
