// import_pool.h — Assets prepared by several threads, each in an import worker of its own, within a bound on
// memory.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/pending_analysis.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::library {

class ImportPool {
 public:
  struct Prepared {
    std::size_t asset = 0;
    std::unique_ptr<pipeline::PendingAnalysis> analysis;
    std::uint64_t bytes = 0;  // of memory, to be released
  };

  // Begins. No import starts while what was prepared and not released takes `most_bytes` or more; those under
  // way may exceed it. `pipeline` and `assets` must outlive the pool.
  ImportPool(pipeline::Pipeline& pipeline, std::span<const std::string> assets, unsigned threads,
             std::uint64_t most_bytes);
  // Leaves what has not begun and waits for what has; Limits::stop of the pipeline's options makes that
  // short.
  ~ImportPool();

  // The next that is ready, in no order. Waits until `deadline`; without one until there is one, or all were
  // taken. Nothing then. Throws what a thread has thrown.
  std::optional<Prepared> take(std::optional<std::chrono::steady_clock::time_point> deadline = {});
  // Whether more than what was taken will come.
  bool has_more() const;
  // As many bytes of what was taken are no longer held.
  void release(std::uint64_t bytes);
  // Waits until no import is under way; none begins before resume().
  void pause();
  void resume();

 private:
  void run();
  std::optional<std::size_t> next();

  pipeline::Pipeline& pipeline_;
  const std::span<const std::string> assets_;
  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t begun_ = 0, taken_ = 0;
  std::uint64_t held_bytes_ = 0;
  unsigned busy_ = 0;  // threads that prepare an asset
  bool paused_ = false, stopping_ = false;
  std::exception_ptr error_;
  std::deque<Prepared> ready_;
  std::vector<std::jthread> threads_;  // last: they use the others
};

}  // namespace scene_analyzer::library
