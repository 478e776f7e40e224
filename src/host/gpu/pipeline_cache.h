// pipeline_cache.h — Compiled pipelines that outlive the process: one file per device and driver. Reached
// through gpu/native.h.
//
// The file holds the driver's data and an 8-byte checksum, so that a damaged file is dropped here and never
// handed to the driver; one of another driver version is refused by the driver itself, by the header inside.
#pragma once

#ifndef VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_NO_CONSTRUCTORS
#endif
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vulkan/vulkan_raii.hpp>

namespace scene_analyzer::gpu {

class PipelineCache {
 public:
  PipelineCache() = default;
  // Loads the file when there is a sound one. Without a folder the cache lives in memory only.
  PipelineCache(const vk::raii::Device& device, const vk::PhysicalDeviceProperties& properties,
                const std::optional<std::filesystem::path>& folder);

  const vk::raii::PipelineCache& handle() const { return cache_; }

  // Writes the file (atomically, synced to disk) when the driver's data differs from what was loaded.
  // Throws std::runtime_error that names the file.
  void save();

 private:
  std::filesystem::path file_;  // empty: kept nowhere
  std::uint64_t loaded_checksum_ = 0;
  bool loaded_ = false;
  vk::raii::PipelineCache cache_{nullptr};
};

}  // namespace scene_analyzer::gpu
