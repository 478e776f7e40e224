#include "window/window.h"

#include <vulkan/vulkan_core.h>
// After Vulkan, whose functions it declares.
#include <GLFW/glfw3.h>

#include <map>

namespace scene_analyzer::window {
namespace {

std::string reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "unknown reason" : text;
}

const std::map<int, KeyName> kNamedKeys = {{GLFW_KEY_ESCAPE, "Esc"},  {GLFW_KEY_LEFT, "Left"},
                                           {GLFW_KEY_RIGHT, "Right"}, {GLFW_KEY_UP, "Up"},
                                           {GLFW_KEY_DOWN, "Down"},   {GLFW_KEY_HOME, "Home"},
                                           {GLFW_KEY_KP_ADD, "+"},    {GLFW_KEY_KP_SUBTRACT, "-"}};

// What the layout writes on it; "=" is "+" where that needs Shift.
KeyName name_of(int key, int scancode) {
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (const auto named = kNamedKeys.find(key); named != kNamedKeys.end()) return named->second;
  const char* written = glfwGetKeyName(key, scancode);
  if (written == nullptr) return {};
  return std::string(written) == "=" ? "+" : written;
}

}  // namespace

Window::Window(const std::string& title, int width, int height) {
  if (glfwInit() != GLFW_TRUE) throw NoDisplay("no window can be opened: " + reason());
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = reason();
    glfwTerminate();
    throw NoDisplay("no window can be opened: " + why);
  }
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, key_changed);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

std::vector<std::string> Window::surface_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw NoDisplay("Vulkan cannot draw to windows of this display: " + reason());
  return {names, names + count};
}

gpu::Presenter::SurfaceMaker Window::surface_maker() const {
  return [window = window_](void* instance) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(static_cast<VkInstance>(instance), window, nullptr, &surface) != VK_SUCCESS)
      return std::uint64_t{0};
    return reinterpret_cast<std::uint64_t>(surface);
  };
}

std::pair<std::uint32_t, std::uint32_t> Window::pixels() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || width <= 0 || height <= 0) return {0, 0};
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return x > 0 ? x : 1;
}

bool Window::should_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::wait_for_events(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  if (glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_FALSE) held_.clear();  // releases go elsewhere
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::key_changed(GLFWwindow* window, int key, int scancode, int action, int) {
  auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
  const KeyName name = name_of(key, scancode);
  if (name.empty()) return;
  if (action == GLFW_RELEASE) self.held_.erase(name);
  if (action != GLFW_PRESS) return;
  self.held_.insert(name);
  if (self.on_key_) self.on_key_(name);
}

}  // namespace scene_analyzer::window
