#include "surface_distances/arcs.h"

#include <algorithm>
#include <span>

#include "gpu/recorder.h"
#include "interface/surface_distances.h"
#include "measure_half_arcs.spv.h"

namespace scene_analyzer::surface_distances {

using interface::mesh::MeshRecord;
using interface::surface_distances::ArcParams;

namespace {

// Three doubles per triangle are more than a storage buffer may hold for the largest batches: done in
// windows.
constexpr std::uint64_t kWindow = std::uint64_t{1} << 20;

template <typename T>
std::span<const T> part(const std::vector<T>& whole, std::uint64_t first, std::uint64_t count) {
  return std::span(whole).subspan(first, count);
}

}  // namespace

MeshSurface BatchSurfaces::surface(std::size_t mesh, const mesh::TriangleMesh& source) const {
  const MeshRecord& record = records[mesh];
  const std::uint64_t first = record.first_triangle, count = record.triangle_count;
  return {.first_triangle = record.first_triangle,
          .areas = part(areas, first, count),
          .twins = part(twins, 3 * first, 3 * count),
          .half_arcs = part(half_arcs, 3 * first, 3 * count),
          .shared = shared,
          .shared_ends = shared_ends,
          .positions = source.positions,
          .indices = source.indices};
}

ArcMeasurer::ArcMeasurer(gpu::Device& device)
    : measure_(device.make_kernel("measure_half_arcs", measure_half_arcs_spv)),
      measure_transformed_(device.make_kernel("measure_half_arcs (transformed)", measure_half_arcs_spv,
                                              geometry::kTransformed)) {}

BatchSurfaces ArcMeasurer::measure(gpu::Device& device, const geometry::Geometry& geometry,
                                   const adjacency::Adjacency& adjacency) const {
  BatchSurfaces result{.areas = geometry.areas.download(device),
                       .twins = adjacency.twin.download(device),
                       .half_arcs = {},
                       .shared = {},
                       .shared_ends = {},
                       .records = geometry.records};
  if (adjacency.shared.count > 0) {
    result.shared = adjacency.shared.half_edges.download(device);
    result.shared_ends = adjacency.shared.ends.download(device);
  }
  const std::uint64_t triangles = geometry.triangle_count;
  result.half_arcs.reserve(3 * triangles);
  const gpu::Array<double> window(device, "half arcs", 3 * std::min(triangles, kWindow));
  for (std::uint64_t first = 0; first < triangles; first += kWindow) {
    const std::uint64_t count = std::min(kWindow, triangles - first);
    gpu::Recorder recorder(device);
    const ArcParams params{.first = static_cast<std::uint32_t>(first),
                           .count = static_cast<std::uint32_t>(count)};
    recorder.run(geometry.transformed ? measure_transformed_ : measure_, count, params,
                 {geometry.meshes, geometry.position_x, geometry.position_y, geometry.position_z,
                  geometry.corners, geometry.mesh_of, geometry.areas, window});
    recorder.submit_and_wait();
    const std::vector<double> lengths = window.download(device, 0, 3 * count);
    result.half_arcs.insert(result.half_arcs.end(), lengths.begin(), lengths.end());
  }
  return result;
}

}  // namespace scene_analyzer::surface_distances
