#include "render_timing/render_timer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "gpu/error.h"
#include "interface/render_timing.h"
#include "render_timing/group_timing.h"
#include "render_timing/mesh_group.h"
// Generated:
#include "count_covered.spv.h"
#include "timed_mesh_frag.spv.h"
#include "timed_mesh_vert.spv.h"

namespace scene_analyzer::render_timing {
namespace {

using analysis::RenderingTime;
using interface::render_timing::TimedDrawParams;

std::vector<RenderingTime> not_measured(std::size_t count, const std::string& why) {
  RenderingTime none;
  none.not_measured = why;
  return std::vector<RenderingTime>(count, none);
}

// A part of the budget, and of the progress.
struct Share {
  double begin = 0, end = 0;
};

std::vector<RenderingTime> measure_part(const Studio& studio, std::span<const TimedMesh> meshes,
                                        const Share& share) {
  const TimingOptions& options = studio.options;
  try {
    const MeshGroup group(studio.device, meshes);
    const auto report = [&](double fraction) {
      if (options.progress)
        options.progress(share.begin + (share.end - share.begin) * std::min(fraction, 1.0));
    };
    return time_group(studio, group, (share.end - share.begin) * options.budget_seconds, report);
  } catch (const gpu::OutOfMemory& error) {
    if (meshes.size() == 1) return not_measured(1, error.what());
  }
  // The device has less than it said. Halves, down to single meshes, so that what fits is measured.
  const std::size_t half = meshes.size() / 2;
  const double middle = (share.begin + share.end) / 2;
  auto times = measure_part(studio, meshes.first(half), {share.begin, middle});
  const auto others = measure_part(studio, meshes.subspan(half), {middle, share.end});
  times.insert(times.end(), others.begin(), others.end());
  return times;
}

}  // namespace

std::string why_not(const gpu::DeviceInfo& device) {
  if (!device.can_draw) return "device " + device.name + " cannot draw";
  if (device.timestamp_bits == 0) return "device " + device.name + " has no timestamps";
  return {};
}

RenderTimer::RenderTimer(gpu::Device& device) : device_(device) {
  if (!why_not(device.info()).empty()) return;
  constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat3};
  pipeline_ = device.make_raster_pipeline("timed_mesh", {.vertex = timed_mesh_vert_spv,
                                                         .fragment = timed_mesh_frag_spv,
                                                         .inputs = kInputs,
                                                         .push_constant_bytes = sizeof(TimedDrawParams)});
  count_covered_ = device.make_kernel("count_covered", count_covered_spv);
}

std::vector<RenderingTime> RenderTimer::measure(std::span<const TimedMesh> meshes,
                                                const TimingOptions& options) const {
  if (const std::string reason = why_not(device_.info()); !reason.empty())
    return not_measured(meshes.size(), reason);
  const Studio studio(device_, pipeline_, count_covered_, options);
  std::uint64_t all = 0;
  for (const TimedMesh& mesh : meshes) all += mesh.indices.size();
  std::vector<RenderingTime> times;
  Share share;
  for (const GroupRange& range : group_meshes(meshes, device_.info())) {
    const auto part = meshes.subspan(range.first, range.end - range.first);
    std::uint64_t here = 0;
    for (const TimedMesh& mesh : part) here += mesh.indices.size();
    share = {share.end, share.end + static_cast<double>(here) / static_cast<double>(all)};
    const auto measured = measure_part(studio, part, share);
    times.insert(times.end(), measured.begin(), measured.end());
  }
  return times;
}

}  // namespace scene_analyzer::render_timing
