// vulkan_errors.h — Vulkan's exceptions end here: what leaves the room is of the gpu::Error family.
#pragma once

#include <functional>
#include <string>

#include "gpu/native.h"

namespace scene_analyzer::gpu {

// To be called inside a catch block: throws DeviceLost, OutOfMemory or Error for the exception being handled,
// with `doing` ("creating pipeline x") in the message. Anything but a vk::SystemError goes on unchanged.
[[noreturn]] void rethrow_as_gpu_error(const std::string& doing);

// The one text for a lost device, with what to do about it.
std::string device_lost_message(const std::string& doing);

template <typename Call>
auto translated(const std::string& doing, Call&& call) {
  try {
    return std::invoke(std::forward<Call>(call));
  } catch (const vk::SystemError&) {
    rethrow_as_gpu_error(doing);
  }
}

}  // namespace scene_analyzer::gpu
