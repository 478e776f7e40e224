#include "geometry/geometry.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "bound_instances.spv.h"
#include "combine_geometry.spv.h"
#include "geometry/upload.h"
#include "measure_triangles.spv.h"
#include "probe_instances.spv.h"
#include "resolve_welds.spv.h"
#include "weld_corners.spv.h"
#include "weld_vertices.spv.h"

namespace scene_analyzer::geometry {

using namespace interface::geometry;
using interface::mesh::kNone;

namespace {

constexpr std::uint32_t kBlocksPerDispatch =
    1 << 18;  // keeps what many instances of large meshes take within 13 MB

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
      probe_instances_(device.make_kernel("probe_instances", probe_instances_spv)),
      bound_instances_(device.make_kernel("bound_instances", bound_instances_spv)) {}

void GeometryBuilder::record_exact_welds(gpu::Recorder& recorder, const Geometry& geometry) const {
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
                geometry.representative});
  recorder.run(resolve_welds_, vertices, ResolveParams{vertices}, {table, geometry.representative});
}

Geometry GeometryBuilder::record(gpu::Recorder& recorder, const Batch& batch, double weld_tolerance) const {
  gpu::Device& device = recorder.device();
  Geometry geometry = upload(device, batch);
  if (weld_tolerance > 0) {
    geometry.representative.upload(device, welds_within(batch, weld_tolerance));
  } else {
    record_exact_welds(recorder, geometry);
  }
  recorder.fill(geometry.referenced, 0);
  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.run(weld_corners_, leaves, ChunkParams{leaves},
               {geometry.chunks.leaves(), geometry.meshes, geometry.representative, geometry.corners,
                geometry.mesh_of, geometry.referenced});
  recorder.run(geometry.transformed ? measure_transformed_ : measure_, leaves, ChunkParams{leaves},
               {geometry.chunks.leaves(), geometry.meshes, geometry.position_x, geometry.position_y,
                geometry.position_z, geometry.corners, geometry.areas, geometry.totals});
  geometry.chunks.record_combine(recorder, combine_, geometry.totals);
  return geometry;
}

std::vector<std::array<double, 6>> GeometryBuilder::bound_instances(
    gpu::Device& device, const Geometry& geometry, std::span<const InstanceToBound> instances) const {
  std::vector<std::array<double, 6>> bounds;
  std::vector<InstanceRecord> window;
  std::uint32_t outputs = 0;
  for (const InstanceToBound& instance : instances) {
    InstanceRecord record{};
    std::copy_n(instance.world.begin(), record.world.size(), record.world.begin());
    const ChunkTree::Range blocks = geometry.chunks.blocks_of(instance.mesh);
    record.first_block = blocks.first;
    record.block_count = blocks.count;
    if (!window.empty() && outputs + blocks.count > kBlocksPerDispatch) {
      bound_window(device, geometry, window, outputs, bounds);
      window.clear();
      outputs = 0;
    }
    record.first_output = outputs;
    outputs += blocks.count;
    window.push_back(record);
  }
  if (!window.empty()) bound_window(device, geometry, window, outputs, bounds);
  return bounds;
}

void GeometryBuilder::bound_window(gpu::Device& device, const Geometry& geometry,
                                   std::span<const InstanceRecord> instances, std::uint32_t outputs,
                                   std::vector<std::array<double, 6>>& bounds) const {
  const auto count = static_cast<std::uint32_t>(instances.size());
  gpu::Array<InstanceRecord> records(device, "instances", count);
  records.upload(device, instances);
  gpu::Array<double> reached(device, "reached by instances", 6 * std::uint64_t{count});
  gpu::Array<double> by_block(device, "bounds of blocks", 6 * std::uint64_t{outputs});
  const ChunkTree& chunks = geometry.chunks;
  const InstanceBoundsParams params{
      .instance_count = count, .output_count = outputs, .first_block = chunks.block_offset()};
  gpu::Recorder recorder(device);
  recorder.run(probe_instances_, 6 * std::uint64_t{count}, params,
               {chunks.leaves(), chunks.blocks(), geometry.meshes, geometry.position_x, geometry.position_y,
                geometry.position_z, geometry.corners, geometry.areas, geometry.totals, records, reached});
  recorder.run(
      bound_instances_, 6 * std::uint64_t{outputs}, params,
      {chunks.leaves(), chunks.blocks(), geometry.meshes, geometry.position_x, geometry.position_y,
       geometry.position_z, geometry.corners, geometry.areas, geometry.totals, records, reached, by_block});
  recorder.submit_and_wait();
  const std::vector<double> found = by_block.download(device);
  for (const InstanceRecord& instance : instances) {
    std::array<double, 6> best;
    best.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 6 * std::size_t{instance.first_output},
                     end = i + 6 * std::size_t{instance.block_count};
         i < end; ++i)
      best[i % 6] = std::max(best[i % 6], found[i]);
    // Lower sides were looked for as maxima of negated coordinates.
    for (const std::size_t lower : {0, 2, 4}) best[lower] = -best[lower];
    bounds.push_back(best);
  }
}

}  // namespace scene_analyzer::geometry
