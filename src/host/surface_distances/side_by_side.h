// side_by_side.h — Independent tasks on a few threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace scene_analyzer::surface_distances {

// Thrown soon after a search was asked to stop.
struct Cancelled {};

// Calls task(i, worker) for i in [0, count), in about that order, from the calling thread and at most
// `workers` - 1 others; calls with the same `worker` follow each other. Returns when all have ended. Rethrows
// the first exception of a task, and throws Cancelled when stopped; tasks that have not begun by then are
// left out.
template <typename Task>
void run_side_by_side(std::size_t count, std::size_t workers, const std::stop_token& stop, Task task) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](std::size_t worker) {
    try {
      for (std::size_t i = next++; i < count && !stop.stop_requested(); i = next++) task(i, worker);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < std::min(count, workers); ++worker)
      threads.emplace_back(work, worker);
    work(0);
  }
  if (failure) std::rethrow_exception(failure);
  if (stop.stop_requested()) throw Cancelled{};
}

}  // namespace scene_analyzer::surface_distances
