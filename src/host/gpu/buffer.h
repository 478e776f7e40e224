// buffer.h — A storage buffer and its memory; typed views of it.
//
// A Buffer owns its Vulkan handles, is movable, and must not outlive its Device nor be destroyed while a
// submitted recording uses it (Recorder::submit_and_wait() returns only afterwards).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::gpu {

class Device;

class Buffer {
 public:
  Buffer();  // empty, only to be assigned to
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  const std::string& name() const;
  std::uint64_t bytes() const;  // 0 when empty
  explicit operator bool() const { return impl_ != nullptr; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

// `count` elements of T from `first` of a buffer; T has the layout of the shader's scalar block.
template <typename T>
class Array {
 public:
  Array() = default;
  Array(Device& device, const std::string& name, std::uint64_t count);  // array_inl below

  std::uint64_t count() const { return count_; }
  const Buffer& buffer() const { return buffer_; }
  explicit operator bool() const { return static_cast<bool>(buffer_); }

  void upload(Device& device, std::span<const T> values, std::uint64_t first = 0) const;
  std::vector<T> download(Device& device) const { return download(device, 0, count_); }
  std::vector<T> download(Device& device, std::uint64_t first, std::uint64_t count) const;

 private:
  Buffer buffer_;
  std::uint64_t count_ = 0;
};

// What a dispatch binds: a buffer, whole or in part. Offsets are multiples of the device's
// minStorageBufferOffsetAlignment (at most 256).
struct BufferRange {
  const Buffer* buffer = nullptr;
  std::uint64_t offset_bytes = 0;
  std::uint64_t size_bytes = 0;  // 0: to the end

  BufferRange(const Buffer& whole) : buffer(&whole) {}  // NOLINT(google-explicit-constructor)
  template <typename T>
  BufferRange(const Array<T>& array) : buffer(&array.buffer()) {}  // NOLINT(google-explicit-constructor)
  BufferRange(const Buffer& part_of, std::uint64_t offset, std::uint64_t size)
      : buffer(&part_of), offset_bytes(offset), size_bytes(size) {}
};

}  // namespace scene_analyzer::gpu

#include "gpu/device.h"  // last: Array's bodies need both
