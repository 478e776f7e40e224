#include "planar_groups/planar_groups.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "combine_groups.spv.h"
#include "count_groups.spv.h"
#include "join_coplanar.spv.h"
#include "join_linked.spv.h"
#include "link_directions.spv.h"
#include "lower_heights.spv.h"
#include "measure_normals.spv.h"
#include "sort_keys_of_directions.spv.h"
#include "sum_groups.spv.h"

namespace scene_analyzer::planar_groups {

using namespace interface::planar_groups;
using interface::mesh::kNone;

namespace {

// A turn in 2^40 steps is finer than the 1e-9 that comparisons may deviate; 2^24 list entries leave room for
// it in a key.
constexpr std::uint32_t kMostAngleBits = 40;

JoinParams join_params(double alpha_degrees) {
  const double alpha = alpha_degrees / 180 * std::numbers::pi;
  return {.alpha = alpha,
          .sin_alpha = std::sin(alpha),
          .cos_alpha = std::cos(alpha),
          .count = 0,
          .angle_bits = 0};
}

}  // namespace

PlanarGroupBuilder::PlanarGroupBuilder(gpu::Device& device, const primitives::Scan& scan,
                                       const primitives::RadixSort& sort)
    : scan_(scan),
      sort_(sort),
      label_sets_(device),
      normals_(device.make_kernel("measure_normals", measure_normals_spv)),
      normals_transformed_(
          device.make_kernel("measure_normals (transformed)", measure_normals_spv, geometry::kTransformed)),
      join_coplanar_(device.make_kernel("join_coplanar", join_coplanar_spv)),
      keys_(device.make_kernel("sort_keys_of_directions", sort_keys_of_directions_spv)),
      keys_transformed_(device.make_kernel("sort_keys_of_directions (transformed)",
                                           sort_keys_of_directions_spv, geometry::kTransformed)),
      lower_heights_(device.make_kernel("lower_heights", lower_heights_spv)),
      link_(device.make_kernel("link_directions", link_directions_spv)),
      link_transformed_(
          device.make_kernel("link_directions (transformed)", link_directions_spv, geometry::kTransformed)),
      join_linked_(device.make_kernel("join_linked", join_linked_spv)),
      count_groups_(device.make_kernel("count_groups", count_groups_spv)),
      sum_groups_(device.make_kernel("sum_groups", sum_groups_spv)),
      combine_(device.make_kernel("combine_groups", combine_groups_spv)) {}

const PlanarGroupBuilder::Normals& PlanarGroupBuilder::record_normals(
    gpu::Recorder& recorder, const geometry::Geometry& geometry) const {
  gpu::Device& device = recorder.device();
  const std::uint64_t count = geometry.triangle_count;
  const Normals& normals =
      recorder.keep(Normals{.x = gpu::Array<double>(device, "normals x", count),
                            .y = gpu::Array<double>(device, "normals y", count),
                            .z = gpu::Array<double>(device, "normals z", count),
                            .heights = gpu::Array<double>(device, "triangle heights", count)});
  recorder.run(
      geometry.transformed ? normals_transformed_ : normals_, count,
      NormalParams{static_cast<std::uint32_t>(count)},
      {geometry.meshes, geometry.position_x, geometry.position_y, geometry.position_z, geometry.corners,
       geometry.mesh_of, geometry.areas, normals.x, normals.y, normals.z, normals.heights});
  return normals;
}

void PlanarGroupBuilder::record_shared(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                       const adjacency::SharedEdges& shared, const Normals& normals,
                                       JoinParams params, const gpu::Array<std::uint32_t>& parent) const {
  gpu::Device& device = recorder.device();
  const std::uint64_t count = shared.count;
  const auto place_bits = static_cast<std::uint32_t>(std::bit_width(count));
  params.count = static_cast<std::uint32_t>(count);
  params.angle_bits = std::min(kMostAngleBits, 64 - place_bits);

  primitives::KeyedValues list = primitives::make_keyed_values(device, "directions", count);
  const auto& height_high =
      recorder.keep(gpu::Array<std::uint32_t>(device, "least heights (high words)", count));
  const auto& height_low =
      recorder.keep(gpu::Array<std::uint32_t>(device, "least heights (low words)", count));
  recorder.fill(height_high, kNone);
  recorder.fill(height_low, kNone);
  recorder.run(geometry.transformed ? keys_transformed_ : keys_, count, params,
               {geometry.meshes, geometry.position_x, geometry.position_y, geometry.position_z,
                geometry.corners, geometry.mesh_of, normals.heights, shared.half_edges, shared.begins,
                list.low, list.high, list.values, height_high});
  recorder.run(lower_heights_, count, params,
               {normals.heights, shared.half_edges, shared.begins, height_high, height_low});
  list = sort_.record(recorder, std::move(list), count, params.angle_bits + place_bits);
  const primitives::KeyedValues& sorted = recorder.keep(std::move(list));

  const auto& steps = recorder.keep(gpu::Array<std::uint32_t>(device, "interval steps", count));
  recorder.fill(steps, 0);
  recorder.run(geometry.transformed ? link_transformed_ : link_, count, params,
               {geometry.meshes, geometry.position_x, geometry.position_y, geometry.position_z,
                geometry.corners, geometry.mesh_of, geometry.totals_of_meshes(), sorted.values, sorted.low,
                sorted.high, shared.begins, shared.ends, height_high, height_low, parent, steps});
  scan_.record(recorder, steps, count);
  recorder.run(join_linked_, count, params, {sorted.values, steps, parent});
}

PlanarGroups PlanarGroupBuilder::record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                        const adjacency::Adjacency& adjacency, double alpha_degrees) const {
  gpu::Device& device = recorder.device();
  const auto triangles = static_cast<std::uint32_t>(geometry.triangle_count);
  PlanarGroups groups{
      .labels = gpu::Array<std::uint32_t>(device, "planar group labels", triangles),
      .sizes = gpu::Array<std::uint32_t>(device, "planar group sizes", triangles),
      .totals = gpu::Array<PlanarTotals>(device, "planar totals", geometry.chunks.partial_count())};
  const Normals& normals = record_normals(recorder, geometry);
  label_sets_.record_singletons(recorder, groups.labels);
  JoinParams params = join_params(alpha_degrees);
  params.count = triangles;
  recorder.run(join_coplanar_, triangles, params,
               {geometry.corners, geometry.mesh_of, geometry.totals_of_meshes(), normals.x, normals.y,
                normals.z, normals.heights, adjacency.twin, groups.labels});
  if (adjacency.shared.count > 0)
    record_shared(recorder, geometry, adjacency.shared, normals, params, groups.labels);
  label_sets_.record_flatten(recorder, groups.labels);

  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.fill(groups.sizes, 0);
  recorder.run(count_groups_, leaves, SizeParams{leaves},
               {geometry.chunks.leaves(), geometry.areas, groups.labels, groups.sizes});
  recorder.run(sum_groups_, leaves, SizeParams{leaves},
               {geometry.chunks.leaves(), groups.sizes, groups.totals});
  geometry.chunks.record_combine(recorder, combine_, groups.totals);
  return groups;
}

}  // namespace scene_analyzer::planar_groups
