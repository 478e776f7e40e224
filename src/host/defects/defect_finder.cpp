#include "defects/defect_finder.h"

#include <algorithm>
#include <cstdint>

#include "combine_triangle_defects.spv.h"
#include "combine_vertex_defects.spv.h"
#include "find_triangle_defects.spv.h"
#include "find_vertex_defects.spv.h"
#include "hash_triangles.spv.h"

namespace scene_analyzer::defects {

using namespace interface::defects;
using interface::mesh::kNone;

namespace {

// Twice as many slots as triangles that can be in it: each has three half-edges on the list of shared ones.
std::uint32_t triangle_slots(const adjacency::SharedEdges& shared) {
  return static_cast<std::uint32_t>(shared.count == 0 ? 1 : shared.count / 3 * 2 + 64);
}

}  // namespace

DefectFinder::DefectFinder(gpu::Device& device)
    : hash_triangles_(device.make_kernel("hash_triangles", hash_triangles_spv)),
      find_triangle_defects_(device.make_kernel("find_triangle_defects", find_triangle_defects_spv)),
      combine_triangle_defects_(device.make_kernel("combine_triangle_defects", combine_triangle_defects_spv)),
      find_vertex_defects_(device.make_kernel("find_vertex_defects", find_vertex_defects_spv)),
      combine_vertex_defects_(device.make_kernel("combine_vertex_defects", combine_vertex_defects_spv)) {}

ChunkDefects DefectFinder::record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                  const adjacency::Adjacency& adjacency) const {
  gpu::Device& device = recorder.device();
  const geometry::ChunkTree& triangles = geometry.chunks;
  ChunkDefects found;
  found.vertex_chunks = geometry::ChunkTree(device, geometry::vertex_ranges(geometry.records));
  const geometry::ChunkTree& vertices = found.vertex_chunks;
  found.triangle_totals = {device, "triangle defects", triangles.partial_count()};
  found.triangle_masks = {device, "triangle defect masks", triangles.leaf_count()};
  found.vertex_totals = {device, "vertex defects", vertices.partial_count()};
  found.vertex_masks = {device, "vertex defect masks", vertices.leaf_count()};

  const std::uint32_t slots = triangle_slots(adjacency.shared);
  const auto& table = recorder.keep(gpu::Array<std::uint32_t>(device, "triangle table", slots));
  recorder.fill(table, kNone);
  if (adjacency.shared.count > 0)
    recorder.run(
        hash_triangles_, geometry.triangle_count,
        RepeatParams{.triangles = static_cast<std::uint32_t>(geometry.triangle_count), .slots = slots},
        {geometry.corners, adjacency.twin, table});
  const auto leaves = [](const geometry::ChunkTree& tree) {
    return static_cast<std::uint32_t>(tree.leaf_count());
  };
  recorder.run(find_triangle_defects_, triangles.leaf_count(),
               FindParams{.chunk_count = leaves(triangles), .slots = slots},
               {triangles.leaves(), geometry.areas, geometry.corners, adjacency.twin,
                adjacency.shared.half_edges, table, found.triangle_totals, found.triangle_masks});
  triangles.record_combine(recorder, combine_triangle_defects_, found.triangle_totals);
  recorder.run(find_vertex_defects_, vertices.leaf_count(),
               FindParams{.chunk_count = leaves(vertices), .slots = 0},
               {vertices.leaves(), geometry.position_x, geometry.position_y, geometry.position_z,
                geometry.representative, geometry.referenced, found.vertex_totals, found.vertex_masks});
  vertices.record_combine(recorder, combine_vertex_defects_, found.vertex_totals);
  return found;
}

}  // namespace scene_analyzer::defects
