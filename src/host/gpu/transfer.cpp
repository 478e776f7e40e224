// Copies between host memory and buffers: Device::upload() and Device::download().
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/run_now.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::uint64_t kStagingBytes = std::uint64_t{16} << 20;

void check_range(const char* what, const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes) {
  if (offset <= buffer.bytes() && bytes <= buffer.bytes() - offset) return;
  throw std::logic_error(std::string(what) + " of bytes " + std::to_string(offset) + " to " +
                         std::to_string(offset + bytes) + " of buffer '" + buffer.name() + "', which has " +
                         std::to_string(buffer.bytes()));
}

bool is_direct(const Device::Native& native, const Buffer& buffer) {
  return buffer.impl().mapped != nullptr && !native.faults.stage_copies;
}

Buffer::Impl& staging(Device::Native& native) {
  if (!native.staging)
    native.staging = make_buffer_impl(native, "staging", kStagingBytes, BufferKind::kStaging);
  return *native.staging;
}

void copy_and_wait(Device::Native& native, vk::Buffer from, vk::Buffer to, const vk::BufferCopy& region,
                   const std::string& doing) {
  run_now(native, doing, [&](const vk::raii::CommandBuffer& commands) {
    record_barrier(commands);
    commands.copyBuffer(from, to, region);
    record_barrier_to_host(commands);
  });
}

}  // namespace

void Device::upload(const Buffer& buffer, std::uint64_t offset_bytes, std::span<const std::byte> data) {
  check_range("upload", buffer, offset_bytes, data.size());
  if (data.empty()) return;
  if (is_direct(*native_, buffer)) {  // visible to the device at the next submission
    std::memcpy(buffer.impl().mapped + offset_bytes, data.data(), data.size());
    return;
  }
  const Buffer::Impl& stage = staging(*native_);
  for (std::uint64_t done = 0; done < data.size(); done += kStagingBytes) {
    const std::uint64_t bytes = std::min<std::uint64_t>(kStagingBytes, data.size() - done);
    std::memcpy(stage.mapped, data.data() + done, bytes);
    copy_and_wait(*native_, *stage.buffer, *buffer.impl().buffer,
                  {.dstOffset = offset_bytes + done, .size = bytes}, "uploading to '" + buffer.name() + "'");
  }
}

void Device::download(const Buffer& buffer, std::uint64_t offset_bytes, std::span<std::byte> data) {
  check_range("download", buffer, offset_bytes, data.size());
  if (data.empty()) return;
  if (is_direct(*native_, buffer)) {  // every recording ends with a barrier to the host
    std::memcpy(data.data(), buffer.impl().mapped + offset_bytes, data.size());
    return;
  }
  const Buffer::Impl& stage = staging(*native_);
  for (std::uint64_t done = 0; done < data.size(); done += kStagingBytes) {
    const std::uint64_t bytes = std::min<std::uint64_t>(kStagingBytes, data.size() - done);
    copy_and_wait(*native_, *buffer.impl().buffer, *stage.buffer,
                  {.srcOffset = offset_bytes + done, .size = bytes},
                  "downloading from '" + buffer.name() + "'");
    std::memcpy(data.data() + done, stage.mapped, bytes);
  }
}

}  // namespace scene_analyzer::gpu
