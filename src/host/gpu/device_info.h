// device_info.h — What a physical device is, and why it cannot be used.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/native.h"

namespace scene_analyzer::gpu {

DeviceInfo describe_device(const vk::raii::PhysicalDevice& device, std::uint32_t index);
std::vector<vk::raii::PhysicalDevice> physical_devices(const Instance& instance);

// The queue family work is submitted to: one with compute and graphics, else one with compute.
// Whether it has what windows need.
bool can_present(const vk::raii::PhysicalDevice& device);

std::optional<std::uint32_t> choose_queue_family(const vk::raii::PhysicalDevice& device);

// Free bytes of the heap that buffers come from (see DeviceInfo::free_memory_bytes).
std::uint64_t free_memory_bytes(const vk::raii::PhysicalDevice& device, DeviceType type);

}  // namespace scene_analyzer::gpu
