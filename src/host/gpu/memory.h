// memory.h — Which of a device's memory types a buffer is put in. Reached through gpu/native.h.
#pragma once

#ifndef VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_NO_CONSTRUCTORS
#endif
#include <cstdint>
#include <optional>
#include <vulkan/vulkan.hpp>

#include "gpu/device.h"

namespace scene_analyzer::gpu {

class MemoryTypes {
 public:
  MemoryTypes() = default;
  MemoryTypes(const vk::PhysicalDeviceMemoryProperties& properties, DeviceType type);

  // Device-local memory; on integrated and CPU devices, where it costs nothing, host-visible too. `allowed`
  // is memoryTypeBits. Absent when no type fits.
  std::optional<std::uint32_t> for_buffers(std::uint32_t allowed) const;
  // Device-local memory. Absent when no type fits.
  std::optional<std::uint32_t> for_images(std::uint32_t allowed) const;
  // Host-visible, coherent, preferably cached: read and written by the host.
  std::optional<std::uint32_t> for_staging(std::uint32_t allowed) const;

  bool is_mapped(std::uint32_t type) const;  // whether buffers of this type are mapped for their whole life
  std::uint32_t heap_of(std::uint32_t type) const { return properties_.memoryTypes[type].heapIndex; }
  std::uint64_t heap_bytes(std::uint32_t type) const { return properties_.memoryHeaps[heap_of(type)].size; }

 private:
  template <typename Score>
  std::optional<std::uint32_t> best(std::uint32_t allowed, Score score) const;

  vk::PhysicalDeviceMemoryProperties properties_;
  bool host_shares_memory_ = false;
};

}  // namespace scene_analyzer::gpu
