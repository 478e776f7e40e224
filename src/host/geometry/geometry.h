// geometry.h — A batch of meshes on the device: welded corners, areas, degenerate triangles, and totals per
// mesh.
//
// Memory per triangle (unwelded mesh in brackets): positions 6 (36), corners 12, mesh 4, areas 8, totals 1;
// while welding also 12 (24) for the hash table and representatives, of which 2 (12) remain.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/chunk_tree.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/geometry.h"
#include "interface/mesh.h"
#include "mesh/scene.h"

namespace scene_analyzer::geometry {

// One mesh of a batch. It must have at least one triangle, and stay alive until GeometryBuilder::record()
// returns.
struct BatchMesh {
  const mesh::TriangleMesh* mesh = nullptr;
  mesh::Matrix3 linear = mesh::kIdentity3;  // looked at only in transformed batches
};

struct Batch {
  std::vector<BatchMesh> meshes;
  bool transformed = false;  // positions are linear * p instead of p
  std::uint64_t vertex_count() const;
  std::uint64_t triangle_count() const;
};

// Specialisation constants of the kernels' variant for transformed batches.
inline constexpr std::uint32_t kTransformed[] = {1};

// The largest batch that `device` can hold: elements of a storage buffer of 4-byte entries, with room in hash
// tables.
struct BatchLimits {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};
BatchLimits batch_limits(const gpu::DeviceInfo& device);

// On the device after record() has run. Index spaces: interface/mesh.h.
struct Geometry {
  std::uint64_t vertex_count = 0;
  std::uint64_t triangle_count = 0;
  bool transformed = false;
  std::vector<interface::mesh::MeshRecord> records;
  ChunkTree chunks;
  gpu::Array<interface::mesh::MeshRecord> meshes;
  gpu::Array<std::uint32_t> position_x, position_y, position_z;
  gpu::Array<std::uint32_t> corners;         // welded: of vertices with equal coordinates the lowest index
  gpu::Array<std::uint32_t> mesh_of;         // per triangle
  gpu::Array<double> areas;                  // 0 for degenerate triangles, positive for kept ones
  gpu::Array<std::uint32_t> representative;  // per vertex: of those welded into one the lowest
  gpu::Array<std::uint32_t> referenced;      // bit v % 32 of word v / 32: whether a triangle names vertex v
  gpu::Array<interface::mesh::GeometryTotals> totals;  // partial results of `chunks`

  // The per-mesh part of `totals`, for kernels.
  gpu::BufferRange totals_of_meshes() const { return chunks.result_range(totals); }
  std::vector<interface::mesh::GeometryTotals> results(gpu::Device& device) const {
    return chunks.results(device, totals);
  }
};

// Where an instance stands, for exact world bounds.
struct InstanceToBound {
  std::uint32_t mesh = 0;  // index in the batch
  mesh::Matrix4 world = mesh::kIdentity4;
};

class GeometryBuilder {
 public:
  explicit GeometryBuilder(gpu::Device& device);

  // Uploads the batch at once and records welding and measuring. With weld_tolerance > 0 vertices within that
  // distance (local units, transitive) are welded on the host first.
  Geometry record(gpu::Recorder& recorder, const Batch& batch, double weld_tolerance = 0) const;

  // Bounds of kept triangles in the world, per instance {min x, max x, min y, max y, min z, max z}; their
  // meshes must have a kept triangle. Runs to completion. Cost: instances x (triangles / kChunkSize^2) and a
  // few chunks each, not instances x triangles.
  std::vector<std::array<double, 6>> bound_instances(gpu::Device& device, const Geometry& geometry,
                                                     std::span<const InstanceToBound> instances) const;

 private:
  void record_exact_welds(gpu::Recorder& recorder, const Geometry& geometry) const;

  void bound_window(gpu::Device& device, const Geometry& geometry,
                    std::span<const interface::geometry::InstanceRecord> instances, std::uint32_t outputs,
                    std::vector<std::array<double, 6>>& bounds) const;

  gpu::Kernel weld_vertices_, resolve_welds_, weld_corners_, measure_, measure_transformed_, combine_,
      probe_instances_, bound_instances_;
};

}  // namespace scene_analyzer::geometry
