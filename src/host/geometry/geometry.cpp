#include "geometry/geometry.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "bound_instances.spv.h"
#include "combine_geometry.spv.h"
#include "geometry/upload.h"
#include "measure_triangles.spv.h"
#include "resolve_welds.spv.h"
#include "weld_corners.spv.h"
#include "weld_vertices.spv.h"

namespace scene_analyzer::geometry {

using namespace interface::geometry;
using interface::mesh::kNone;

namespace {

constexpr std::uint32_t kTransformed[] = {1};
constexpr std::size_t kInstancesPerDispatch = 65536;  // bounds the memory that records of instances take

// Twice as many slots as vertices where a storage buffer can hold them: probes stay short.
std::uint32_t weld_slots(const gpu::DeviceInfo& device, std::uint64_t vertices) {
  const std::uint64_t most = device.max_storage_buffer_bytes / sizeof(std::uint32_t);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>({2 * vertices + 64, most, kNone - 1}));
}

}  // namespace

std::uint64_t Batch::vertex_count() const {
  return std::accumulate(
      meshes.begin(), meshes.end(), std::uint64_t{0},
      [](std::uint64_t sum, const BatchMesh& entry) { return sum + entry.mesh->vertex_count(); });
}

std::uint64_t Batch::triangle_count() const {
  return std::accumulate(
      meshes.begin(), meshes.end(), std::uint64_t{0},
      [](std::uint64_t sum, const BatchMesh& entry) { return sum + entry.mesh->triangle_count(); });
}

BatchLimits batch_limits(const gpu::DeviceInfo& device) {
  // Half-edges carry a flag in their top bit. Open addressing needs free slots even when nothing can be
  // welded.
  const std::uint64_t entries =
      std::min<std::uint64_t>(device.max_storage_buffer_bytes / sizeof(std::uint32_t), 0x7FFFFFFF);
  const std::uint64_t usable = entries / 20 * 19;
  return {.vertices = usable, .triangles = usable / 3};
}

GeometryBuilder::GeometryBuilder(gpu::Device& device)
    : weld_vertices_(device.make_kernel("weld_vertices", weld_vertices_spv)),
      resolve_welds_(device.make_kernel("resolve_welds", resolve_welds_spv)),
      weld_corners_(device.make_kernel("weld_corners", weld_corners_spv)),
      measure_(device.make_kernel("measure_triangles", measure_triangles_spv)),
      measure_transformed_(
          device.make_kernel("measure_triangles (transformed)", measure_triangles_spv, kTransformed)),
      combine_(device.make_kernel("combine_geometry", combine_geometry_spv)),
      bound_instances_(device.make_kernel("bound_instances", bound_instances_spv)) {}

void GeometryBuilder::record_exact_welds(gpu::Recorder& recorder, const Geometry& geometry,
                                         const gpu::Array<std::uint32_t>& representative) const {
  gpu::Device& device = recorder.device();
  const auto vertices = static_cast<std::uint32_t>(geometry.vertex_count);
  const std::uint32_t slots = weld_slots(device.info(), vertices);
  const auto& table = recorder.keep(gpu::Array<std::uint32_t>(device, "weld table", slots));
  recorder.fill(table, kNone);
  const WeldParams weld{.vertex_count = vertices,
                        .mesh_count = static_cast<std::uint32_t>(geometry.records.size()),
                        .slots = slots};
  recorder.run(weld_vertices_, vertices, weld,
               {geometry.position_x, geometry.position_y, geometry.position_z, geometry.meshes, table,
                representative});
  recorder.run(resolve_welds_, vertices, ResolveParams{vertices}, {table, representative});
}

Geometry GeometryBuilder::record(gpu::Recorder& recorder, const Batch& batch, double weld_tolerance) const {
  gpu::Device& device = recorder.device();
  Geometry geometry = upload(device, batch);
  const auto& representative =
      recorder.keep(gpu::Array<std::uint32_t>(device, "vertex representatives", geometry.vertex_count));
  if (weld_tolerance > 0) {
    representative.upload(device, welds_within(batch, weld_tolerance));
  } else {
    record_exact_welds(recorder, geometry, representative);
  }
  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.run(
      weld_corners_, leaves, ChunkParams{leaves},
      {geometry.chunks.leaves(), geometry.meshes, representative, geometry.corners, geometry.mesh_of});
  recorder.run(geometry.transformed ? measure_transformed_ : measure_, leaves, ChunkParams{leaves},
               {geometry.chunks.leaves(), geometry.meshes, geometry.position_x, geometry.position_y,
                geometry.position_z, geometry.corners, geometry.areas, geometry.totals});
  geometry.chunks.record_combine(recorder, combine_, geometry.totals);
  return geometry;
}

std::vector<std::array<double, 6>> GeometryBuilder::bound_instances(
    gpu::Device& device, const Geometry& geometry, std::span<const InstanceToBound> instances) const {
  std::vector<std::array<double, 6>> bounds;
  for (std::size_t first = 0; first < instances.size(); first += kInstancesPerDispatch) {
    const auto window = instances.subspan(first, std::min(kInstancesPerDispatch, instances.size() - first));
    std::vector<InstanceRecord> records;
    for (const InstanceToBound& instance : window) {
      InstanceRecord record{};
      std::copy_n(instance.world.begin(), record.world.size(), record.world.begin());
      record.first_chunk = geometry.chunks.first_leaf(instance.mesh);
      const std::uint32_t triangles = geometry.records[instance.mesh].triangle_count;
      record.chunk_count = (triangles + interface::mesh::kChunkSize - 1) / interface::mesh::kChunkSize;
      records.push_back(record);
    }
    gpu::Array<InstanceRecord> uploaded(device, "instances", records.size());
    uploaded.upload(device, records);
    gpu::Array<std::array<double, 6>> found(device, "instance bounds", records.size());
    gpu::Recorder recorder(device);
    recorder.run(bound_instances_, 6 * records.size(),
                 InstanceBoundsParams{static_cast<std::uint32_t>(records.size())},
                 {geometry.chunks.leaves(), geometry.meshes, geometry.position_x, geometry.position_y,
                  geometry.position_z, geometry.corners, geometry.areas, geometry.totals, uploaded, found});
    recorder.submit_and_wait();
    const auto window_bounds = found.download(device);
    bounds.insert(bounds.end(), window_bounds.begin(), window_bounds.end());
  }
  return bounds;
}

}  // namespace scene_analyzer::geometry
