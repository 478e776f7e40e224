// render_target.h — What is drawn into: a colour image of 8 bits per channel and a depth image of 32 bits,
// with one sample per pixel or several, which smooth edges.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace scene_analyzer::gpu {

class Device;

class RenderTarget {
 public:
  RenderTarget();  // empty, only to be assigned to
  ~RenderTarget();
  RenderTarget(RenderTarget&&) noexcept;
  RenderTarget& operator=(RenderTarget&&) noexcept;

  std::uint32_t width() const;
  std::uint32_t height() const;
  std::uint32_t samples() const;  // per pixel
  // Of the colour image: 4 per pixel (red, green, blue, alpha), rows from top to bottom.
  std::uint64_t color_bytes() const { return std::uint64_t{4} * width() * height(); }
  explicit operator bool() const { return impl_ != nullptr; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::gpu
