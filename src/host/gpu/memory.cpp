#include "gpu/memory.h"

namespace scene_analyzer::gpu {
namespace {

using Flag = vk::MemoryPropertyFlagBits;
constexpr vk::MemoryPropertyFlags kMappable = Flag::eHostVisible | Flag::eHostCoherent;
// Needs a device feature or has other rules; never wanted here.
constexpr vk::MemoryPropertyFlags kUnwanted =
    Flag::eProtected | Flag::eLazilyAllocated | Flag::eDeviceCoherentAMD | Flag::eDeviceUncachedAMD;

bool has(vk::MemoryPropertyFlags flags, vk::MemoryPropertyFlags wanted) {
  return (flags & wanted) == wanted;
}

}  // namespace

MemoryTypes::MemoryTypes(const vk::PhysicalDeviceMemoryProperties& properties, DeviceType type)
    : properties_(properties),
      host_shares_memory_(type == DeviceType::kIntegrated || type == DeviceType::kCpu) {}

// The type of the highest score; of equals the first, which is the driver's preference. A negative score
// excludes.
template <typename Score>
std::optional<std::uint32_t> MemoryTypes::best(std::uint32_t allowed, Score score) const {
  std::optional<std::uint32_t> found;
  int highest = -1;
  for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
    const vk::MemoryPropertyFlags flags = properties_.memoryTypes[type].propertyFlags;
    if ((allowed >> type & 1u) == 0 || (flags & kUnwanted)) continue;
    if (const int value = score(flags); value > highest) {
      highest = value;
      found = type;
    }
  }
  return found;
}

std::optional<std::uint32_t> MemoryTypes::for_buffers(std::uint32_t allowed) const {
  return best(allowed, [this](vk::MemoryPropertyFlags flags) {
    int score = has(flags, Flag::eDeviceLocal) ? 4 : 0;
    if (host_shares_memory_)
      score += (has(flags, kMappable) ? 2 : 0) + (has(flags, kMappable | Flag::eHostCached) ? 1 : 0);
    // A discrete GPU's host-visible window is often small, and slow to read.
    else if (!has(flags, Flag::eHostVisible))
      score += 2;
    return score;
  });
}

std::optional<std::uint32_t> MemoryTypes::for_images(std::uint32_t allowed) const {
  return best(allowed, [](vk::MemoryPropertyFlags flags) { return has(flags, Flag::eDeviceLocal) ? 1 : 0; });
}

std::optional<std::uint32_t> MemoryTypes::for_staging(std::uint32_t allowed) const {
  return best(allowed, [](vk::MemoryPropertyFlags flags) {
    if (!has(flags, kMappable)) return -1;
    return (has(flags, Flag::eHostCached) ? 2 : 0) + (has(flags, Flag::eDeviceLocal) ? 0 : 1);
  });
}

bool MemoryTypes::is_mapped(std::uint32_t type) const {
  return host_shares_memory_ && has(properties_.memoryTypes[type].propertyFlags, kMappable);
}

}  // namespace scene_analyzer::gpu
