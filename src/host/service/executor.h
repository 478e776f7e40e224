// executor.h — The order in which requests are worked on: imports side by side, one device for all.
//
//   submit -> waiting -> import workers -> ready -> device thread -> answer
//
// Requests that are ready at the same time go to the device together, as far as their parameters are the
// same; the results are those that each would have had alone. Rendering is timed with nothing else on the
// device, and on devices that share the processors with nothing imported beside it. What the store or the
// import answers goes past the device.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/pipeline.h"
#include "service/device_worker.h"
#include "service/job.h"
#include "service/metrics.h"
#include "service/work_queue.h"

namespace scene_analyzer::service {

struct ExecutorOptions {
  unsigned import_workers = 1;  // at least 1
  // Of scenes that wait for the device or its results; none is imported while they take more.
  std::uint64_t most_bytes = std::uint64_t{1} << 30;
};

class Executor {
 public:
  // `device` gives a device, a new one when it is called again: the former was lost. `log_error` is told what
  // is the machine's or the program's fault. Both may be called by any thread. Throws std::system_error where
  // the system starts no more threads.
  Executor(const ExecutorOptions& options, std::function<gpu::Device&()> device, Metrics& metrics,
           std::function<void(const std::string&)> log_error);
  // What is not done is refused.
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  std::shared_ptr<Job> submit(Order order);
  // Nobody waits for it any more. Also for a job that is done.
  void cancel(const std::shared_ptr<Job>& job) { queue_.cancel(job); }
  WorkQueue::Depth depth() const { return queue_.depth(); }
  analysis::DeviceStamp device();  // throws gpu::NoDevice

 private:
  void run_imports();
  void run_device();
  std::optional<Imported> prepare(const std::shared_ptr<Job>& job);
  std::optional<Imported> import(const std::shared_ptr<Job>& job);
  void answer_without_device(const std::shared_ptr<Job>& job,
                             std::unique_ptr<pipeline::PendingAnalysis> analysis);
  void try_alone_or_refuse(const std::shared_ptr<Job>& job, const std::string& what);
  bool wants_quiet(const Job& job);
  void log(const std::string& message) const { log_error_(message); }

  Metrics& metrics_;
  const std::function<void(const std::string&)> log_error_;
  pipeline::Pipeline pipeline_;
  WorkQueue queue_;
  DeviceWorker worker_;
  std::vector<std::jthread> threads_;  // last: they use the others
};

}  // namespace scene_analyzer::service
