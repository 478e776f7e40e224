// array_inl.h — Bodies of gpu::Array, which need the whole Device. Include gpu/device.h or gpu/buffer.h, not
// this.
#pragma once

#include "gpu/device.h"

namespace scene_analyzer::gpu {

template <typename T>
Array<T>::Array(Device& device, const std::string& name, std::uint64_t count)
    : buffer_(device.make_buffer(name, count * sizeof(T))), count_(count) {}

template <typename T>
void Array<T>::upload(Device& device, std::span<const T> values, std::uint64_t first) const {
  device.upload(buffer_, first * sizeof(T), std::as_bytes(values));
}

template <typename T>
std::vector<T> Array<T>::download(Device& device, std::uint64_t first, std::uint64_t count) const {
  std::vector<T> values(count);
  device.download(buffer_, first * sizeof(T), std::as_writable_bytes(std::span<T>(values)));
  return values;
}

}  // namespace scene_analyzer::gpu
