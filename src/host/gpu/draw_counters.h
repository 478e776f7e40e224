// draw_counters.h — Pipeline statistics around the draws of one recording. Reached through gpu/native.h.
#pragma once

#ifndef VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_NO_CONSTRUCTORS
#endif
#include <cstdint>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "gpu/recorder.h"

namespace scene_analyzer::gpu {

class DrawCounters {
 public:
  // The device, which outlives this, has pipelineStatisticsQuery.
  explicit DrawCounters(const vk::raii::Device& device) : device_(&device) {}

  void start(const vk::raii::CommandBuffer& commands);
  void stop(const vk::raii::CommandBuffer& commands);

  // In order; call it after the recording has run. The next recording begins a new list.
  std::vector<Recorder::DrawCounts> take();
  void clear() { count_ = 0; }

 private:
  const vk::raii::Device* device_;
  std::vector<vk::raii::QueryPool> pools_;
  std::uint32_t count_ = 0;  // draws of this recording
};

}  // namespace scene_analyzer::gpu
