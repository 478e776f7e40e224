// stopwatch.h — GPU timestamps around the dispatches and renderings of one recording. Reached through
// gpu/native.h.
#pragma once

#ifndef VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_NO_CONSTRUCTORS
#endif
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "gpu/recorder.h"

namespace scene_analyzer::gpu {

// Ticks between two readings of a counter of `valid_bits` bits, which may wrap once in between; absent when
// it ran backwards.
std::optional<std::uint64_t> elapsed_ticks(std::uint64_t from, std::uint64_t to, std::uint32_t valid_bits);

class Stopwatch {
 public:
  // `nanoseconds_per_tick` is timestampPeriod; `valid_bits` of the queue family is not 0. The device outlives
  // this.
  Stopwatch(const vk::raii::Device& device, double nanoseconds_per_tick, std::uint32_t valid_bits);

  // Brackets what is recorded between the two calls.
  void start(const vk::raii::CommandBuffer& commands, const std::string& name);
  void stop(const vk::raii::CommandBuffer& commands);

  // The times, in order; call it after the recording has run. The next start() begins a new list.
  std::vector<Recorder::Timing> take();
  void clear() { names_.clear(); }

 private:
  const vk::raii::Device* device_;
  double nanoseconds_per_tick_;
  std::uint32_t valid_bits_;
  std::vector<vk::raii::QueryPool> pools_;  // of kBracketsPerPool brackets each, kept for the next recording
  std::vector<std::string> names_;          // one per bracket
};

}  // namespace scene_analyzer::gpu
