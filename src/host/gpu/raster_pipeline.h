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
enum class VertexFormat { kFloat3 };

struct RasterShaders {
  std::span<const std::uint32_t> vertex, fragment;  // SPIR-V, "main" in both
  std::span<const VertexFormat> inputs;
  std::uint32_t push_constant_bytes = 0;  // of the block that both stages may read
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
