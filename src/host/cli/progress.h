// progress.h — What a long run over some assets is doing, on standard error (status_line.h).
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cli/status_line.h"

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

class Progress {
 public:
  explicit Progress(bool enabled, std::size_t assets,
                    std::chrono::milliseconds silence = std::chrono::seconds(2));

  // Assets count from 0; several may be under way.
  void start_asset(std::size_t asset, const std::string& name);
  void update(std::size_t asset, double fraction, const std::string& step);  // of this asset, [0,1]
  void finish_asset(std::size_t asset);

  // Runs `print`, which writes to the terminal, with the bar out of the way.
  void aside(const std::function<void()>& print) { status_.aside(print); }

 private:
  struct Asset {
    std::string name;
    double done = 0;
  };
  void raise(std::size_t asset, double fraction);

  ProgressState state_;
  std::vector<Asset> assets_;
  StatusLine status_;  // last: it draws the others
};

}  // namespace scene_analyzer::cli
