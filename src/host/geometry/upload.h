// upload.h — Copies the meshes of a batch into device buffers.
#pragma once

#include "geometry/geometry.h"

namespace scene_analyzer::geometry {

// Allocates and fills records, positions (x, y and z apart, so that each stays within a storage buffer's
// range) and indices within each mesh.
Geometry upload(gpu::Device& device, const Batch& batch);

// Representatives of vertices within `tolerance` of each other, per vertex of the batch, computed on the
// host.
std::vector<std::uint32_t> welds_within(const Batch& batch, double tolerance);

}  // namespace scene_analyzer::geometry
