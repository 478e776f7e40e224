#include "pipeline/batching.h"

#include <fmt/format.h>

#include <algorithm>

namespace scene_analyzer::pipeline {
namespace {

// A batch of several meshes stays below this: enough to fill a device, little enough to stay small in memory.
constexpr std::uint64_t kFillingTriangles = 4'000'000;
constexpr std::size_t kMostMeshes = 100'000;  // per batch: records and totals take 400 bytes per mesh

std::uint64_t usable_memory(const gpu::DeviceInfo& device) {
  return device.free_memory_bytes / 10 * 9;
}

std::string beyond_limits(const mesh::TriangleMesh& mesh, const gpu::DeviceInfo& device,
                          const geometry::BatchLimits& limits) {
  const std::uint64_t vertices = mesh.vertex_count(), triangles = mesh.triangle_count();
  if (triangles > limits.triangles || vertices > limits.vertices)
    return fmt::format(
        "needs buffers for {} triangles and {} vertices; {} binds at most {} bytes to a buffer "
        "(maxStorageBufferRange), enough for {} triangles and {} vertices",
        triangles, vertices, device.name, device.max_storage_buffer_bytes, limits.triangles, limits.vertices);
  const std::uint64_t need = memory_needed(vertices, triangles);
  if (need > usable_memory(device))
    return fmt::format("needs about {} bytes of device memory; {} has {} free", need, device.name,
                       device.free_memory_bytes);
  return {};
}

bool fits(const geometry::Batch& batch, const mesh::TriangleMesh& mesh, const gpu::DeviceInfo& device,
          const geometry::BatchLimits& limits, std::uint64_t vertices, std::uint64_t triangles) {
  if (batch.meshes.empty()) return true;
  vertices += mesh.vertex_count();
  triangles += mesh.triangle_count();
  return batch.meshes.size() < kMostMeshes && triangles <= std::min(limits.triangles, kFillingTriangles) &&
         vertices <= limits.vertices && memory_needed(vertices, triangles) <= usable_memory(device);
}

}  // namespace

std::uint64_t memory_needed(std::uint64_t vertices, std::uint64_t triangles) {
  // Positions and corners are there throughout. The peak is either while vertices are welded and half-edges
  // matched, or while areas are sorted into classes.
  const std::uint64_t while_matching = 25 * vertices + 52 * triangles;
  const std::uint64_t while_sorting = 12 * vertices + 96 * triangles;
  return std::max(while_matching, while_sorting) + (std::uint64_t{1} << 20);
}

std::vector<PlannedBatch> plan_batches(const mesh::Scene& scene, const gpu::DeviceInfo& device,
                                       std::vector<analysis::GeometryAnalysis>& geometries) {
  const geometry::BatchLimits limits = geometry::batch_limits(device);
  std::vector<PlannedBatch> batches;
  for (const bool transformed : {false, true}) {
    PlannedBatch open{.batch = {.meshes = {}, .transformed = transformed}, .geometries = {}};
    std::uint64_t vertices = 0, triangles = 0;
    for (std::uint32_t index = 0; index < geometries.size(); ++index) {
      analysis::GeometryAnalysis& geometry = geometries[index];
      const mesh::TriangleMesh& mesh = scene.meshes[geometry.mesh];
      if ((geometry.linear != mesh::kIdentity3) != transformed || mesh.triangle_count() == 0) continue;
      geometry.not_analysed = beyond_limits(mesh, device, limits);
      if (!geometry.not_analysed.empty()) continue;
      if (!fits(open.batch, mesh, device, limits, vertices, triangles)) {
        batches.push_back(std::move(open));
        open = {.batch = {.meshes = {}, .transformed = transformed}, .geometries = {}};
        vertices = triangles = 0;
      }
      open.batch.meshes.push_back({.mesh = &mesh, .linear = geometry.linear});
      open.geometries.push_back(index);
      vertices += mesh.vertex_count();
      triangles += mesh.triangle_count();
    }
    if (!open.batch.meshes.empty()) batches.push_back(std::move(open));
  }
  return batches;
}

}  // namespace scene_analyzer::pipeline
