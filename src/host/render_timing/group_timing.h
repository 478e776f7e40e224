// group_timing.h — The rounds of one group of meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "render_timing/mesh_group.h"
#include "render_timing/render_timer.h"

namespace scene_analyzer::render_timing {

// What all draws of one measurement share.
struct Studio {
  gpu::Device& device;
  const gpu::RasterPipeline& pipeline;
  const gpu::Kernel& count_covered;
  const TimingOptions& options;
  gpu::RenderTarget target;
  std::array<float, 2> aspect;

  Studio(gpu::Device& on, const gpu::RasterPipeline& with, const gpu::Kernel& counter,
         const TimingOptions& wanted)
      : device(on),
        pipeline(with),
        count_covered(counter),
        options(wanted),
        target(on.make_render_target("render timing", wanted.width, wanted.height)) {
    const auto smaller = static_cast<float>(std::min(wanted.width, wanted.height));
    aspect = {smaller / static_cast<float>(wanted.width), smaller / static_cast<float>(wanted.height)};
  }

  // Clears the picture and draws one mesh, as a rendering of its own.
  void draw(gpu::Recorder& recorder, const MeshGroup& group, std::size_t mesh,
            std::uint32_t rotation_index) const;
};

// `progress` is told the part of the budget that is spent. Throws gpu::OutOfMemory, gpu::DeviceLost.
std::vector<analysis::RenderingTime> time_group(const Studio& studio, const MeshGroup& group,
                                                double budget_seconds, std::function<void(double)> progress);

}  // namespace scene_analyzer::render_timing
