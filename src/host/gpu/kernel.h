// kernel.h — One compute pipeline and what its SPIR-V says about itself.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace scene_analyzer::gpu {

class Device;

class Kernel {
 public:
  Kernel();  // empty, only to be assigned to
  ~Kernel();
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;

  const std::string& name() const;
  std::uint32_t local_size() const;           // threads per workgroup (one-dimensional)
  std::uint32_t buffer_count() const;         // storage buffers, bindings 0..count-1 of set 0
  std::uint32_t push_constant_bytes() const;  // size of the parameter block, 0 when there is none
  explicit operator bool() const { return impl_ != nullptr; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::gpu
