// draw.h — The picture that a job orders.
#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "mesh/scene.h"
#include "service/job.h"

namespace scene_analyzer::service {

// The bytes of a PNG file. `scene`: the job's asset, with textures. Appends warnings to `messages`. Throws
// InputError when the scene is not what was analysed or shows nothing, gpu::OutOfMemory, gpu::DeviceLost,
// gpu::Error when the device cannot draw it, std::bad_alloc, GivenUp.
std::string draw_picture(gpu::Device& device, Job& job, mesh::Scene scene,
                         const analysis::AssetAnalysis& analysis, std::vector<std::string>& messages);

}  // namespace scene_analyzer::service
