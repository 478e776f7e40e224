// run_now.h — One recording outside a Recorder: copies between host memory and the device.
#pragma once

#include <string>

#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {

// Records with `record` and waits until it has run. `doing` goes into messages.
template <typename Record>
void run_now(Device::Native& native, const std::string& doing, const Record& record) {
  const vk::raii::CommandBuffer commands = native.make_commands();
  translated(doing, [&] {
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
  });
  native.submit_and_wait(*commands, doing);
}

}  // namespace scene_analyzer::gpu
