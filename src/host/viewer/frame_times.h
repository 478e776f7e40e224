// frame_times.h — How fluently a window moved: times between pictures that followed each other at once.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scene_analyzer::viewer {

class FrameTimes {
 public:
  // A picture was shown at `seconds` of any clock. `at_once`: the window did not sleep since the one before.
  void shown(double seconds, bool at_once);

  // Between the last two that followed each other at once; 0 before.
  double last_milliseconds() const { return last_ * 1000; }
  // "412 pictures in motion: 47.1 per second, half of them within 21.2 ms, 95 % within 24.8 ms"; nothing
  // without any. Memory and cost: of the latest 100000.
  std::optional<std::string> summary() const;

 private:
  std::vector<float> times_;  // seconds, of the latest
  std::size_t count_ = 0;     // of all
  double last_ = 0;
  std::optional<double> before_;
};

}  // namespace scene_analyzer::viewer
