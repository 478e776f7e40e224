// batching.h — Cuts the geometries of a scene into batches that the device can hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "mesh/scene.h"

namespace scene_analyzer::pipeline {

struct PlannedBatch {
  geometry::Batch batch;
  std::vector<std::uint32_t> geometries;  // batch mesh -> index of the geometry
};

// Device memory for a batch, an upper estimate in bytes; see the headers of the stages.
std::uint64_t memory_needed(std::uint64_t vertices, std::uint64_t triangles);

// Geometries without source triangles are in no batch. One that is beyond a limit of the device is in none
// either: its `not_analysed` says what it needs and what the limit is.
std::vector<PlannedBatch> plan_batches(const mesh::Scene& scene, const gpu::DeviceInfo& device,
                                       std::vector<analysis::GeometryAnalysis>& geometries);

}  // namespace scene_analyzer::pipeline
