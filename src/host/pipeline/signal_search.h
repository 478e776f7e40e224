// signal_search.h — The search for start triangles beside the device's work.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <vector>

#include "pipeline/batching.h"
#include "surface_distances/arcs.h"
#include "surface_distances/signal.h"

namespace scene_analyzer::pipeline {

// Runs on threads of its own, all of the host's, from start() to finish(). Destroyed before it has finished,
// because another stage failed, it cancels the search and waits for its end.
class SignalSearch {
 public:
  ~SignalSearch();

  void start(surface_distances::BatchSurfaces surfaces, const PlannedBatch& plan,
             std::uint64_t most_searches);
  bool started() const { return result_.valid(); }
  bool is_running() const;
  // Waits; meanwhile `progress` is told the fraction that is done a few times a second.
  std::vector<surface_distances::Signal> finish(const std::function<void(double fraction)>& progress);

 private:
  surface_distances::BatchSurfaces surfaces_;
  std::stop_source stop_;
  std::atomic<double> done_ = 0;
  std::future<std::vector<surface_distances::Signal>> result_;
};

}  // namespace scene_analyzer::pipeline
