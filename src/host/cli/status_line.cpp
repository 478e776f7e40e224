#include "cli/status_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "cli/terminal.h"

namespace scene_analyzer::cli {
namespace {

using namespace std::chrono_literals;
constexpr auto kBarInterval = 200ms;
constexpr auto kLineInterval = 5s;
constexpr const char* kWipeLine = "\r\x1b[K";

}  // namespace

std::string fitted(std::string text, std::size_t width) {
  if (width == 0 || text.size() <= width) return text;
  text.resize(width);
  // Not in the middle of a UTF-8 character.
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xc0) text.pop_back();
  return text;
}

StatusLine::StatusLine(bool enabled, Text text, std::chrono::milliseconds silence)
    : bar_(is_terminal(STDERR_FILENO)), silence_(silence), text_(std::move(text)) {
  if (enabled) thread_ = std::jthread([this](const std::stop_token& stop) { draw_until_stopped(stop); });
}

StatusLine::~StatusLine() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  wipe();
}

void StatusLine::aside(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  wipe();
  print();
}

void StatusLine::draw_until_stopped(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  auto wait = silence_;
  // The predicate is only true on stop: the wait is a pause that a stop cuts short.
  while (!changed_.wait_for(lock, stop, wait, [&] { return stop.stop_requested(); })) {
    if (bar_) {
      // One column is left free: some terminals wrap when the last one is written.
      const std::size_t width = terminal_width(STDERR_FILENO);
      fmt::print(stderr, "{}{}", kWipeLine, text_.bar(width > 1 ? width - 1 : 0));
      std::fflush(stderr);
      drawn_ = true;
      wait = kBarInterval;
    } else {
      fmt::print(stderr, "{}\n", text_.line());
      wait = kLineInterval;
    }
  }
}

void StatusLine::wipe() {
  if (!drawn_) return;
  fmt::print(stderr, "{}", kWipeLine);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace scene_analyzer::cli
