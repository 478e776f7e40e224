// status_line.h — A line on standard error that says how far a long run is: redrawn in place on a terminal, a
// new line every few seconds elsewhere. Nothing in the first two seconds, so that short runs stay silent.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace scene_analyzer::cli {

// `text` in at most `width` columns (0: unlimited), cut off between two characters.
std::string fitted(std::string text, std::size_t width);

// Draws from a thread of its own, because importing a file and a step on the GPU do not report back for
// seconds.
class StatusLine {
 public:
  // What to draw; both are called with the mutex held. `bar` gets the columns of the terminal, 0: unlimited.
  struct Text {
    std::function<std::string(std::size_t width)> bar;
    std::function<std::string()> line;
  };

  StatusLine(bool enabled, Text text, std::chrono::milliseconds silence = std::chrono::seconds(2));
  ~StatusLine();  // wipes the bar
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  // Held while `text` is asked for: whatever it looks at is to be changed under it.
  std::mutex& mutex() { return mutex_; }
  // Runs `print`, which writes to the terminal, with the bar out of the way.
  void aside(const std::function<void()>& print);

 private:
  void draw_until_stopped(const std::stop_token& stop);
  void wipe();

  const bool bar_;
  const std::chrono::milliseconds silence_;
  const Text text_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool drawn_ = false;
  std::jthread thread_;  // last: starts when all else is there, joins first
};

}  // namespace scene_analyzer::cli
