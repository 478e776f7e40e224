// progress.h — What a long run is doing, on standard error: a bar that redraws itself on a terminal, a line
// every few seconds elsewhere. Nothing in the first two seconds, so that short runs stay silent.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace scene_analyzer::cli {

struct ProgressState {
  std::size_t asset = 0, assets = 1;  // which of how many
  double done = 0;                    // of all, counted in assets
  std::string name, step;             // file name; "planar groups"
};

// " 42% [########            ] 2/3 room.glb: planar groups", at most `width` columns (0: unlimited).
std::string progress_bar(const ProgressState& state, std::size_t width);
// "progress: 42%, asset 2 of 3, room.glb: planar groups"
std::string progress_line(const ProgressState& state);

// Draws from a thread of its own, because importing a file and a step on the GPU do not report back for
// seconds.
class Progress {
 public:
  explicit Progress(bool enabled, std::size_t assets,
                    std::chrono::milliseconds silence = std::chrono::seconds(2));
  ~Progress();  // wipes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Assets count from 0; several may be under way.
  void start_asset(std::size_t asset, const std::string& name);
  void update(std::size_t asset, double fraction, const std::string& step);  // of this asset, [0,1]
  void finish_asset(std::size_t asset);

  // Runs `print`, which writes to the terminal, with the bar out of the way.
  void aside(const std::function<void()>& print);

 private:
  struct Asset {
    std::string name;
    double done = 0;
  };
  void raise(std::size_t asset, double fraction);
  void draw_until_stopped(const std::stop_token& stop);
  void wipe();

  const bool bar_;
  const std::chrono::milliseconds silence_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  ProgressState state_;
  std::vector<Asset> assets_;
  bool drawn_ = false;
  std::jthread thread_;  // last: starts when all else is there, joins first
};

}  // namespace scene_analyzer::cli
