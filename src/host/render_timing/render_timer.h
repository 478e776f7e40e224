// render_timer.h — How long meshes take to draw: each alone, offscreen, from steps x steps directions,
// measured with the device's own timestamps.
//
// A round draws every mesh from every direction, mesh after mesh; rounds follow each other until the times
// are sure enough, so that whatever else the machine does in the meantime troubles all meshes alike, and
// medians over the rounds leave it out. The target is cleared before each draw and everything else has ended;
// the clearing is not part of the time. Formula: docs/metrics.md, rendering time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "render_timing/framing.h"

namespace scene_analyzer::render_timing {

struct TimingOptions {
  std::uint32_t width = 512, height = 512;  // pixels
  std::uint32_t steps = 8;                  // rotations about each axis, 1..kMostSteps
  double budget_seconds = 30;               // for all meshes together, > 0
  // Rounds go on until half of every mesh's 95 % interval is at most this part of its mean.
  double precision = 0.02;
  std::function<void(double fraction)> progress = {};  // never falls; may throw, which ends the measurement
};
inline constexpr std::uint32_t kMostSteps = 256;

// Why the device cannot time anything; or empty.
std::string why_not(const gpu::DeviceInfo& device);

class RenderTimer {
 public:
  explicit RenderTimer(gpu::Device& device);

  // One time per mesh, in order. The budget is kept but for three draws of each mesh and one more round;
  // where it does not allow a round of all rotations, fewer are drawn, the same of all meshes. What cannot be
  // measured has `not_measured`: on a device that cannot draw or has no clock, for a mesh that does not fit
  // its memory, when its clock runs backwards. Throws gpu::DeviceLost. Memory on the device: see MeshGroup;
  // two pictures.
  std::vector<analysis::RenderingTime> measure(std::span<const TimedMesh> meshes,
                                               const TimingOptions& options) const;

 private:
  gpu::Device& device_;
  gpu::RasterPipeline pipeline_;
  gpu::Kernel count_covered_;
};

}  // namespace scene_analyzer::render_timing
