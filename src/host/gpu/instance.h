// instance.h — The Vulkan instance, and the validation layer's messages. Reached through gpu/native.h.
#pragma once

#ifndef VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_NO_CONSTRUCTORS
#endif
#include <memory>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace scene_analyzer::gpu {

// The layer calls from any thread that calls Vulkan, drivers' own included.
class ValidationLog {
 public:
  void add(std::string message);
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

struct Instance {
  std::unique_ptr<ValidationLog> log;  // at a fixed address, outlives the instance that writes to it
  vk::raii::Context context;
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
};

// `surface_extensions`: what a window needs, or nothing. Throws NoDevice when there is no Vulkan loader or no
// driver, Error when the validation layer is wanted but missing.
Instance make_instance(bool validation, const std::vector<std::string>& surface_extensions = {});

}  // namespace scene_analyzer::gpu
