// window.h — A window of the desktop: its size, its keys, and a surface for gpu::Presenter.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gpu/presenter.h"

struct GLFWwindow;

namespace scene_analyzer::window {

// There is no display, or it takes no window: the message has the reason.
class NoDisplay : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A key by what stands on it: "a", ";", "+", "F1", "Esc", "Left", "Right", "Up", "Down", "Home".
using KeyName = std::string;

// One per process and thread, on the main thread.
class Window {
 public:
  // `width` and `height` in the desktop's units. Throws NoDisplay.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // For gpu::DeviceOptions. Throws NoDisplay when the display's system has no way to show what Vulkan draws.
  std::vector<std::string> surface_extensions() const;
  gpu::Presenter::SurfaceMaker surface_maker() const;

  std::pair<std::uint32_t, std::uint32_t> pixels() const;  // 0 x 0 while it is minimised
  float scale() const;  // pixels per unit of text: 1, or 2 on a dense display
  bool should_close() const;
  void close();
  void set_title(const std::string& title);

  // Called for every key that goes down, not for repetitions.
  void on_key(std::function<void(const KeyName&)> call) { on_key_ = std::move(call); }
  const std::set<KeyName>& held() const { return held_; }

  // Sleeps until something happens, at most `seconds`; 0 looks without sleeping.
  void wait_for_events(double seconds);
  // Ends the sleep from any thread.
  static void wake();

  GLFWwindow* handle() const { return window_; }

 private:
  static void key_changed(GLFWwindow* window, int key, int scancode, int action, int modifiers);

  GLFWwindow* window_ = nullptr;
  std::function<void(const KeyName&)> on_key_;
  std::set<KeyName> held_;
};

}  // namespace scene_analyzer::window
