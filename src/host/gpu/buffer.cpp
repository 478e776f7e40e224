#include "gpu/buffer.h"

#include <algorithm>

#include "gpu/error.h"
#include "gpu/host_memory.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::uint64_t kGranularity = 16;
// Smaller needs are not worth a look at the system's free memory.
constexpr std::uint64_t kLookAtFreeMemory = std::uint64_t{1} << 20;

[[noreturn]] void refuse(const std::string& name, std::uint64_t need, const std::string& limit) {
  throw OutOfMemory("buffer '" + name + "' needs " + std::to_string(need) + " bytes, but " + limit);
}

void check_limits(const DeviceInfo& info, const std::string& name, std::uint64_t bytes, BufferKind kind) {
  if (kind == BufferKind::kStorage && bytes > info.max_storage_buffer_bytes)
    refuse(name, bytes,
           "the device's largest storage buffer has " + std::to_string(info.max_storage_buffer_bytes) +
               " bytes (maxStorageBufferRange)");
  if (bytes > info.max_allocation_bytes)
    refuse(name, bytes,
           "the device's largest allocation has " + std::to_string(info.max_allocation_bytes) +
               " bytes (maxMemoryAllocationSize)");
  check_free_memory(info, "buffer '" + name + "'", bytes);
}

void allocate(Device::Native& native, Buffer::Impl& impl, std::uint32_t type, std::uint64_t bytes) {
  if (allocation_fails(native.faults)) throw vk::OutOfDeviceMemoryError("asked for by a test");
  impl.memory = vk::raii::DeviceMemory(native.device, {.allocationSize = bytes, .memoryTypeIndex = type});
  impl.buffer.bindMemory(*impl.memory, 0);
}

std::unique_ptr<Buffer::Impl> make_device_buffer(Device::Native& native, const std::string& name,
                                                 std::uint64_t bytes, BufferKind kind) {
  check_limits(native.info, name, bytes, kind);  // before rounding, which could overflow
  const std::uint64_t rounded =
      (std::max<std::uint64_t>(bytes, 1) + kGranularity - 1) / kGranularity * kGranularity;
  check_limits(native.info, name, rounded, kind);
  return make_buffer_impl(native, name, rounded, kind);
}

}  // namespace

void check_free_memory(const DeviceInfo& info, const std::string& what, std::uint64_t bytes) {
  if (info.type != DeviceType::kCpu || bytes < kLookAtFreeMemory) return;
  if (const auto free = free_host_memory_bytes(); free && bytes > *free)
    throw OutOfMemory(what + " needs " + std::to_string(bytes) + " bytes, but this machine has " +
                      std::to_string(*free) + " bytes of memory left");
}

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

const std::string& Buffer::name() const {
  static const std::string kEmpty;
  return impl_ ? impl_->name : kEmpty;
}
std::uint64_t Buffer::bytes() const {
  return impl_ ? impl_->bytes : 0;
}

std::unique_ptr<Buffer::Impl> make_buffer_impl(Device::Native& native, const std::string& name,
                                               std::uint64_t bytes, BufferKind kind) {
  auto impl = std::make_unique<Buffer::Impl>(native, name);
  vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;
  if (kind == BufferKind::kStorage) usage |= vk::BufferUsageFlagBits::eStorageBuffer;
  if (kind == BufferKind::kVertex)
    usage |= vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer;
  try {
    impl->buffer = vk::raii::Buffer(native.device, {.size = bytes, .usage = usage});
    const vk::MemoryRequirements need = impl->buffer.getMemoryRequirements();
    const auto type = kind == BufferKind::kStaging ? native.memory_types.for_staging(need.memoryTypeBits)
                                                   : native.memory_types.for_buffers(need.memoryTypeBits);
    if (!type) throw Error("the device has no memory type for buffer '" + name + "'");
    allocate(native, *impl, *type, need.size);
    if (kind == BufferKind::kStaging || native.memory_types.is_mapped(*type))
      impl->mapped = static_cast<std::byte*>(impl->memory.mapMemory(0, VK_WHOLE_SIZE));
  } catch (const vk::OutOfDeviceMemoryError&) {
    refuse(name, bytes,
           "the driver refused it with " + std::to_string(native.buffer_bytes) +
               " bytes in use by other buffers");
  } catch (const vk::OutOfHostMemoryError&) {
    refuse(name, bytes, "the driver ran out of host memory");
  } catch (const vk::SystemError&) {
    rethrow_as_gpu_error("making buffer '" + name + "'");
  }
  native.set_name(vk::ObjectType::eBuffer,
                  reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(*impl->buffer)), name);
  if (kind == BufferKind::kStaging) return impl;
  impl->bytes = bytes;
  native.buffer_bytes += bytes;
  native.peak_buffer_bytes = std::max(native.peak_buffer_bytes, native.buffer_bytes);
  return impl;
}

Buffer Device::make_buffer(const std::string& name, std::uint64_t bytes) {
  Buffer buffer;
  buffer.impl_ = make_device_buffer(*native_, name, bytes, BufferKind::kStorage);
  return buffer;
}

Buffer Device::make_vertex_buffer(const std::string& name, std::uint64_t bytes) {
  Buffer buffer;
  buffer.impl_ = make_device_buffer(*native_, name, bytes, BufferKind::kVertex);
  return buffer;
}

}  // namespace scene_analyzer::gpu
