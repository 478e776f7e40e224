// faults.h — A door for tests: makes a device fail, or take the slower way, on purpose. Vulkan-free.
#pragma once

#include <cstdint>
#include <optional>

namespace scene_analyzer::gpu {

class Device;

struct Faults {
  std::optional<std::uint32_t>
      allocations_until_failure;  // 0: the next allocation fails as if the driver refused
  bool lose_device_at_next_submit = false;
  bool clock_runs_backwards = false;  // timestamps are no times
  bool stage_copies = false;          // copy through the staging buffer although the memory is host-visible
};

Faults& faults(Device& device);
// To be asked before each allocation of device memory: whether this one is to fail.
bool allocation_fails(Faults& faults);

}  // namespace scene_analyzer::gpu
