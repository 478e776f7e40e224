// raster_pipeline.h — One graphics pipeline: triangles with a vertex and a fragment shader, depth tested,
// seen from both sides.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace scene_analyzer::gpu {

class Device;

// What a vertex shader reads at location 0, 1, ...; each location has a buffer of its own, tightly packed.
enum class VertexFormat {
  kFloat2,
  kFloat3,
  kUint1,      // 32 bits
  kUnorm8x4,   // four numbers of 8 bits, 0 to 255 read as 0 to 1
  kUnorm16x2,  // two numbers of 16 bits, 0 to 65535 read as 0 to 1
};

struct RasterState {
  std::uint32_t samples = 1;  // per pixel, as many as the target's
  // Greater depths are nearer: with 1 / distance as depth, float32 is equally precise at all distances.
  bool reversed_depth = false;
  // Colours are laid over what is there by their alpha; what lies behind such triangles stays visible, be it
  // drawn before or after them.
  bool translucent = false;
  bool tests_depth = true;  // otherwise depths are neither compared nor written
  bool wireframe = false;   // edges only; needs DeviceInfo::draws_wireframes
};

struct RasterShaders {
  std::span<const std::uint32_t> vertex, fragment;  // SPIR-V, "main" in both
  std::span<const VertexFormat> inputs;
  std::uint32_t push_constant_bytes = 0;  // of the block that both stages may read
  // What the fragment shader reads in set 0: a texture at binding 0, this many storage buffers at 1, 2, ...
  bool reads_texture = false;
  std::uint32_t buffer_count = 0;
  RasterState state = {};
};

class RasterPipeline {
 public:
  RasterPipeline();  // empty, only to be assigned to
  ~RasterPipeline();
  RasterPipeline(RasterPipeline&&) noexcept;
  RasterPipeline& operator=(RasterPipeline&&) noexcept;

  explicit operator bool() const { return impl_ != nullptr; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::gpu
