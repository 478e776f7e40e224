// job.h — One request on its way through the executor.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analysis.h"
#include "mesh/asset_source.h"
#include "pictures/picture_content.h"
#include "pictures/scene_studio.h"
#include "pipeline/pipeline.h"
#include "service/refusal.h"

namespace scene_analyzer::service {

struct PictureOrder {
  pictures::Content content;
  pictures::PictureFormat format;
  ratings::Options rating;
};

struct Order {
  mesh::AssetSource asset;
  std::shared_ptr<const void> files;  // kept as long as the job: what was uploaded
  pipeline::Options options;          // but for import_limits.stop, which is the job's
  std::optional<PictureOrder> picture;
};

// What became of it. Without a refusal there is an analysis, and a picture where one was ordered.
struct Answer {
  std::optional<Refusal> refusal;
  std::optional<analysis::AssetAnalysis> analysis;
  bool from_store = false;
  std::vector<std::string> messages;
  std::string png;
};

class Job {
 public:
  explicit Job(Order order);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const Order& order() const { return order_; }
  std::shared_ptr<const pipeline::Options> options() const { return options_; }

  // --- For who has ordered it ---

  // It ends at the next step, as refused; Executor::cancel() also takes it out of the queue.
  void cancel();
  struct State {
    double fraction = 0;  // [0, 1], never falling
    std::string step = "waiting";
    bool done = false;
    std::uint64_t version = 0;  // of this state; each change has the next
  };
  // Waits until the state is another than that of version `seen`, or `deadline`.
  State wait(std::uint64_t seen, std::chrono::steady_clock::time_point deadline) const;
  // Once it is done.
  Answer take_answer();

  // --- For the executor ---

  bool is_cancelled() const { return stop_.stop_requested(); }
  // What is measured together ends when nobody waits for any of it.
  bool is_given_up() const { return given_up_ ? given_up_() : is_cancelled(); }
  void share_fate(std::function<bool()> given_up) { given_up_ = std::move(given_up); }
  void report(double fraction, const std::string& step);
  void finish(Answer answer);  // the first counts
  void refuse(Reason reason, const std::string& what);
  bool is_done() const;
  // True once: whether what may have been the fault of its neighbours was tried alone already.
  bool try_alone() { return !std::exchange(alone_, true); }
  bool is_alone() const { return alone_; }

 private:
  const Order order_;
  std::stop_source stop_;
  std::shared_ptr<const pipeline::Options> options_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  State state_;
  Answer answer_;
  // Of the executor's threads, one after the other.
  bool alone_ = false;
  std::function<bool()> given_up_;
};

}  // namespace scene_analyzer::service
