// texture.h — An image that fragment shaders read: 8 bits per channel, filtered, repeated beyond its edges,
// with smaller versions of itself for what is far away.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace scene_analyzer::gpu {

class Device;

class Texture {
 public:
  Texture();  // empty, only to be assigned to
  ~Texture();
  Texture(Texture&&) noexcept;
  Texture& operator=(Texture&&) noexcept;

  explicit operator bool() const { return impl_ != nullptr; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::gpu
