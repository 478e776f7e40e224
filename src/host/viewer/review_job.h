// review_job.h — Assets are analysed and loaded in a thread of their own, so that a window stays responsive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "gpu/device.h"
#include "pipeline/pipeline.h"
#include "viewer/reviewed_asset.h"

namespace scene_analyzer::viewer {

class ReviewJob {
 public:
  using Finished = ReviewedAsset;

  struct Progress {
    std::size_t asset = 0, assets = 0;  // this one, of so many; equal when there is nothing more to do
    std::string name;                   // file name of the asset
    std::string step;                   // "planar groups"
    double fraction = 0;                // of this asset, [0,1]; never falls
  };

  // Starts at once, one asset after the other; one given twice is analysed once. `on_change` is called in the
  // job's thread whenever one of the functions below may have news, for a window that sleeps: it must not
  // throw, call the job, or wait for whoever destroys it.
  ReviewJob(std::vector<std::filesystem::path> assets, pipeline::Options options, gpu::DeviceOptions device,
            std::function<void()> on_change = {});
  // Stops and waits for the end, which comes at the next step: within milliseconds on most assets, and as
  // late as one submission to the device takes on large ones. An import is ended in the middle.
  ~ReviewJob() = default;
  ReviewJob(const ReviewJob&) = delete;
  ReviewJob& operator=(const ReviewJob&) = delete;

  // These may be called from any thread and do not wait.
  Progress progress() const;
  // Those that came since the last call, in the order given, failed ones among them. Until they are taken,
  // they stay in memory.
  std::vector<Finished> take_finished();
  // Nothing more will come: all was done, it was stopped, or it failed.
  bool done() const;
  // Why it ended before all assets were looked at (no device, device lost, a defect); not when it was
  // stopped.
  std::optional<std::string> failure() const;
  // Of the validation layer, where DeviceOptions asked for it.
  std::vector<std::string> take_validation_messages();
  void request_stop() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop, pipeline::Options options, const gpu::DeviceOptions& device);
  void review_all(const std::stop_token& stop, AssetReviewer& reviewer);
  void begin(std::size_t asset);
  void report(double fraction, const std::string& step);
  void deliver(Finished finished);
  void keep_validation_messages(AssetReviewer& reviewer);
  void tell() const;

  const std::vector<std::filesystem::path> assets_;
  const std::function<void()> on_change_;
  mutable std::mutex mutex_;  // of all that follows
  Progress progress_;
  std::vector<Finished> finished_;
  std::vector<std::string> validation_messages_;
  std::optional<std::string> failure_;
  bool done_ = false;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace scene_analyzer::viewer
