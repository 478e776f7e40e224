// reflection.h — What a compute shader's SPIR-V says about itself. Vulkan-free.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::gpu {

struct BlockMember {
  std::string name;
  std::uint32_t offset_bytes = 0;
  std::uint32_t size_bytes = 0;  // without trailing padding; 0 for a runtime array
};

struct StorageBinding {
  std::uint32_t binding = 0;
  std::string name;  // of the variable, or of the block where the variable has none
};

struct Reflection {
  std::array<std::uint32_t, 3> local_size{};
  std::vector<StorageBinding> storage_buffers;  // set 0, ascending; two variables may share a binding
  std::uint32_t buffer_count = 0;               // bindings are 0..buffer_count-1, without gaps
  std::uint32_t push_constant_bytes = 0;        // what sizeof says of the same struct in C++
  std::vector<BlockMember> push_constants;      // in order; members of a struct inside stand in its place
};

// `specialization` gives constants 0, 1, ... their values, which local sizes may depend on.
// Throws gpu::Error when the words are no compute shader, or use what kernels may not: other sets, gaps
// between bindings, arrays of descriptors, images or uniform buffers.
Reflection reflect(std::span<const std::uint32_t> words, std::span<const std::uint32_t> specialization = {});

}  // namespace scene_analyzer::gpu
