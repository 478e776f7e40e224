// fourier_share.h — What the spectra of many small meshes take of a whole run.
#pragma once

#include "gpu/device.h"

namespace scene_analyzer::bench {

// 20000 meshes of 12 to 3000 triangles through the whole recipe, and then their spectra alone: prints one
// line of a table.
void print_fourier_share(gpu::Device& device);

}  // namespace scene_analyzer::bench
