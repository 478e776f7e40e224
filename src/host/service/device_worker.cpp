#include "service/device_worker.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "base/error.h"
#include "gpu/error.h"
#include "import/import.h"
#include "pipeline/pending_analysis.h"
#include "service/draw.h"

namespace scene_analyzer::service {
namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t triangles_of(const analysis::AssetAnalysis& analysis) {
  std::uint64_t triangles = 0;
  for (const auto& geometry : analysis.geometries) triangles += geometry.source_triangles;
  return triangles;
}

// The time in which the device's thread works.
class BusyTime {
 public:
  explicit BusyTime(Metrics& metrics) : metrics_(metrics) {}
  ~BusyTime() { metrics_.add_device_seconds(std::chrono::duration<double>(Clock::now() - begin_).count()); }
  BusyTime(const BusyTime&) = delete;
  BusyTime& operator=(const BusyTime&) = delete;

 private:
  Metrics& metrics_;
  const Clock::time_point begin_ = Clock::now();
};

}  // namespace

Answer answer_of(pipeline::Outcome outcome, Metrics& metrics) {
  Answer answer;
  answer.messages = std::move(outcome.messages);
  if (!outcome.analysis) {
    // What needs more than there is was tried with nothing beside it.
    answer.refusal.emplace(outcome.may_succeed_alone ? Reason::kTooLarge : Reason::kInvalid, outcome.error);
    return answer;
  }
  answer.analysis = std::move(outcome.analysis);
  answer.from_store = outcome.from_file;
  if (answer.from_store)
    metrics.count_answer_from_store();
  else
    metrics.count_triangles(triangles_of(*answer.analysis));
  return answer;
}

bool DeviceWorker::Pack::is_given_up() const {
  return std::ranges::all_of(jobs,
                             [](const auto& job) { return !job || job->is_cancelled() || job->is_done(); });
}

DeviceWorker::DeviceWorker(pipeline::Pipeline& pipeline, Metrics& metrics, WorkerEvents events)
    : pipeline_(pipeline), metrics_(metrics), events_(std::move(events)) {}

DeviceWorker::~DeviceWorker() {
  for (const auto& pack : pending_) refuse_all(*pack, Reason::kUnavailable, kShuttingDown);
}

void DeviceWorker::start(std::vector<Imported> imported) {
  auto pack = std::make_unique<Pack>();
  std::vector<std::unique_ptr<pipeline::PendingAnalysis>> analyses;
  for (Imported& one : imported) {
    if (was_refused(one)) continue;
    one.job->share_fate([pack = pack.get()] { return pack->is_given_up(); });
    pack->bytes += one.bytes;
    pack->jobs.push_back(std::move(one.job));
    pack->pictures.push_back(std::move(one.picture));
    analyses.push_back(std::move(one.analysis));
  }
  if (pack->jobs.empty()) return;
  metrics_.count_pack(pack->jobs.size());
  if (!attempt(*pack, [&] { pack->pending = pipeline_.start_pack(std::move(analyses)); })) return;
  if (pack->pending->is_searching())
    pending_.push_back(std::move(pack));
  else
    finish(*pack);
}

// The device may have been lost with its asset after it was imported.
bool DeviceWorker::was_refused(const Imported& one) {
  if (losses_.refused() == one.refused_before) return false;
  try {
    losses_.check(one.job->order().asset);
    return false;
  } catch (const Refusal& refusal) {
    one.job->refuse(refusal.reason(), refusal.what());
  } catch (const std::exception&) {  // its file is gone, or there is no memory for it; it was read before
    return false;
  }
  events_.released(one.bytes);
  return true;
}

void DeviceWorker::finish_searched() {
  for (auto pack = pending_.begin(); pack != pending_.end();) {
    if ((*pack)->pending && (*pack)->pending->is_searching() && !(*pack)->is_given_up()) {
      ++pack;
      continue;
    }
    const std::unique_ptr<Pack> ended = std::move(*pack);
    pack = pending_.erase(pack);
    finish(*ended);
    if (pending_.empty()) break;  // also those behind it were lost with the device
  }
}

void DeviceWorker::finish_all() {
  while (!pending_.empty()) {
    const std::unique_ptr<Pack> pack = std::move(pending_.front());
    pending_.pop_front();
    finish(*pack);
  }
}

void DeviceWorker::finish(Pack& pack) {
  const bool ended_well = attempt(pack, [&] {
    if (pack.is_given_up()) throw GivenUp();
    pipeline_.finish_pack(std::move(pack.pending), [&](std::size_t index, pipeline::Outcome outcome) {
      answer(pack, index, std::move(outcome));
    });
  });
  if (ended_well) events_.released(pack.bytes);
}

bool DeviceWorker::attempt(Pack& pack, const std::function<void()>& step) {
  const auto end = [&](const std::function<void()>& answer_jobs) {
    pack.pending.reset();
    answer_jobs();
    events_.released(pack.bytes);
    return false;
  };
  const BusyTime busy(metrics_);
  try {
    step();
    return true;
  } catch (const GivenUp& error) {
    return end([&] { refuse_all(pack, Reason::kCancelled, error.what()); });
  } catch (const gpu::DeviceLost& error) {
    lose(pack, error.what());
    return false;
  } catch (const gpu::NoDevice& error) {
    return end([&] {
      events_.error(error.what());
      refuse_all(pack, Reason::kUnavailable, error.what());
    });
  } catch (const std::exception& error) {
    return end([&] {
      events_.error(error.what());
      refuse_all(pack, Reason::kInternal, kDefect);
    });
  }
}

// Nobody knows whose fault it was: each is tried alone, also those that only waited. Nothing that is pending
// outlives the device.
void DeviceWorker::lose(Pack& pack, const std::string& what) {
  metrics_.count_device_loss();
  events_.error(what);
  const auto give_up = [&](Pack& lost, bool is_at_fault) {
    lost.pending.reset();
    try_again_or_refuse(lost, is_at_fault, what);
    events_.released(lost.bytes);
  };
  const bool was_alone = pack.jobs.size() == 1 && pending_.empty();
  if (was_alone) record_loss(pack.jobs.front()->order().asset);
  give_up(pack, was_alone);
  for (const auto& other : std::exchange(pending_, {})) give_up(*other, false);
  pipeline_.forget_device();
}

void DeviceWorker::record_loss(const mesh::AssetSource& asset) {
  try {
    losses_.add(asset);
  } catch (const std::exception& error) {
    events_.error(std::string("which asset the device was lost with is not recorded: ") + error.what());
  }
}

void DeviceWorker::try_again_or_refuse(const Pack& pack, bool is_at_fault, const std::string& what) {
  for (const auto& job : pack.jobs) {
    if (!job || job->is_done()) continue;
    job->share_fate({});
    if (!is_at_fault && job->try_alone())
      events_.try_again(job);
    else
      job->refuse(Reason::kUnavailable, what + " The service goes on with a fresh device; try again");
  }
}

void DeviceWorker::refuse_all(const Pack& pack, Reason reason, const std::string& what) {
  for (const auto& job : pack.jobs) {
    if (!job) continue;
    job->share_fate({});
    job->refuse(reason, what);
  }
}

void DeviceWorker::answer(Pack& pack, std::size_t index, pipeline::Outcome outcome) {
  const std::shared_ptr<Job> job = pack.jobs[index];
  if (job->is_cancelled()) return job->refuse(Reason::kCancelled, GivenUp().what());
  if (!outcome.analysis && outcome.may_succeed_alone && job->try_alone()) {
    job->share_fate({});
    pack.jobs[index] = nullptr;  // whatever becomes of the others
    return events_.try_again(job);
  }
  Answer answer = answer_of(std::move(outcome), metrics_);
  if (!answer.refusal && job->order().picture) draw(*job, pack.pictures[index], answer);
  job->finish(std::move(answer));
}

void DeviceWorker::draw(Job& job, mesh::Scene scene, Answer& answer) {
  try {
    answer.png = draw_picture(pipeline_.device(), job, std::move(scene), *answer.analysis, answer.messages);
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const InputError& error) {
    answer.refusal.emplace(Reason::kInvalid, error.what());
  } catch (const gpu::OutOfMemory& error) {
    answer.refusal.emplace(Reason::kTooLarge, std::string(error.what()) + "; try a smaller picture");
  } catch (const std::bad_alloc&) {
    answer.refusal.emplace(Reason::kTooLarge,
                           "the service's machine has too little free memory; try a smaller picture");
  } catch (const gpu::Error& error) {
    answer.refusal.emplace(Reason::kInvalid, error.what());
  }
}

}  // namespace scene_analyzer::service
