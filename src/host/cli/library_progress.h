// library_progress.h — How far a run over a library is, how fast, and how long it will take.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "cli/status_line.h"

namespace scene_analyzer::cli {

struct LibraryState {
  std::uint64_t assets = 0, done = 0, failed = 0;  // failed: of those done, not analysed
  double per_second = 0;                           // assets, of late; 0 where that is not known
  std::string name = {};                           // of the asset that was finished last
};

// How many are done per second, over the last 10 to 20 seconds: assets that are unchanged take no time, and
// say nothing about those that have to be measured.
class RecentRate {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RecentRate(Time begin) : former_{begin, 0}, latest_{begin, 0} {}
  double per_second(Time now, std::uint64_t done);

 private:
  struct Mark {
    Time time;
    std::uint64_t done;
  };
  Mark former_, latest_;
};

// " 42% [##########              ] 840/2000 assets, 1310/min, 53 s left, 3 not analysed: chair.glb", at most
// `width` columns (0: unlimited).
std::string library_bar(const LibraryState& state, std::size_t width);
// "progress: 42%, 840 of 2000 assets, 1310/min, 53 s left, 3 not analysed"
std::string library_line(const LibraryState& state);
// "53 s", "4 min", "7.5 h".
std::string duration_text(double seconds);

class LibraryProgress {
 public:
  LibraryProgress(bool enabled, std::uint64_t assets);

  void finish_asset(const std::string& name, bool analysed);
  // Runs `print`, which writes to the terminal, with the bar out of the way.
  void aside(const std::function<void()>& print) { status_.aside(print); }

 private:
  LibraryState now();

  RecentRate rate_{std::chrono::steady_clock::now()};
  LibraryState state_;
  StatusLine status_;  // last: it draws the others
};

// Of merging: "reading analyses: 1200 of 2000".
class MergeStatus {
 public:
  explicit MergeStatus(bool enabled);
  void update(std::uint64_t done, std::uint64_t assets);

 private:
  std::string text() const;

  std::uint64_t done_ = 0, assets_ = 0;
  StatusLine status_;  // last: it draws the others
};

}  // namespace scene_analyzer::cli
