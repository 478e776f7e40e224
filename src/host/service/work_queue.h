// work_queue.h — Which job is imported next, and which go to the device together.
//
//   add -> waiting -> next_to_import ... imported -> ready -> take_pack
//
// Jobs are imported in the order in which they came. What is ready at the same time goes to the device
// together, as far as parameters and metrics are the same. An import that is tried again alone has nothing
// imported beside it. What is timed with nothing beside it waits until no import is under way: none begins
// meanwhile, and what need not be timed is taken before it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "service/device_worker.h"
#include "service/job.h"

namespace scene_analyzer::service {

// Whether its rendering is timed.
bool wants_times(const Job& job);

class WorkQueue {
 public:
  // `most_bytes`: of imported scenes that are not released yet; no import begins while they take more.
  explicit WorkQueue(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  // --- By any thread ---

  // At the end, or as the first.
  void add(std::shared_ptr<Job> job, bool first = false);
  void release(std::uint64_t bytes);
  // Nobody waits for it any more: it is refused at once if it waits or is ready, else at its next step.
  void cancel(const std::shared_ptr<Job>& job);
  // Refuses what waits, is imported or is ready, and whatever is added from now on.
  void end();
  bool has_ended() const;
  struct Depth {
    std::size_t waiting = 0, ready = 0;
  };
  Depth depth() const;

  // --- By the threads that import ---

  // Waits for it; none when the queue has ended. imported() has to follow.
  std::shared_ptr<Job> next_to_import();
  // Without `result` it has its answer, or was added again.
  void imported(const std::shared_ptr<Job>& job, std::optional<Imported> result);

  // --- By the device's thread ---

  // Waits until something is ready, or what is pending on the device (packs) wants to be looked at: then
  // none. None as well when the queue has ended.
  std::vector<Imported> take_pack(std::size_t pending);
  // What was taken has been measured: imports go on, where they were held up for it.
  void measured();

 private:
  std::deque<Imported>::iterator next_ready();
  std::vector<Imported> take(const std::deque<Imported>::iterator& first);

  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> waiting_;
  std::set<std::shared_ptr<Job>> importing_;
  std::deque<Imported> ready_;
  std::uint64_t held_bytes_ = 0;
  bool import_is_alone_ = false;                           // the one that is under way
  bool quiet_is_wanted_ = false, timing_quietly_ = false;  // no import begins
  bool ended_ = false;
};

}  // namespace scene_analyzer::service
