#include "adjacency/adjacency.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "combine_topology.spv.h"
#include "count_shared.spv.h"
#include "gather_shared.spv.h"
#include "hash_half_edges.spv.h"
#include "index_shared.spv.h"
#include "join_components.spv.h"
#include "key_shared.spv.h"
#include "link_half_edges.spv.h"
#include "locate_shared.spv.h"
#include "start_components.spv.h"
#include "sum_topology.spv.h"

namespace scene_analyzer::adjacency {

using namespace interface::adjacency;
using interface::mesh::kNone;

namespace {

// A quarter more slots than half-edges, so that even a soup whose edges are all boundaries leaves free ones.
std::uint32_t edge_slots(const gpu::DeviceInfo& device, std::uint64_t half_edges) {
  const std::uint64_t most = device.max_storage_buffer_bytes / sizeof(std::uint32_t);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>({half_edges + half_edges / 4 + 64, most, kNone - 1}));
}

double slots_per_vertex(std::uint32_t slots, const geometry::Geometry& geometry) {
  return static_cast<double>(slots) / static_cast<double>(geometry.vertex_count);
}

}  // namespace

AdjacencyBuilder::AdjacencyBuilder(gpu::Device& device, const primitives::RadixSort& sort)
    : sort_(sort),
      label_sets_(device),
      hash_half_edges_(device.make_kernel("hash_half_edges", hash_half_edges_spv)),
      link_half_edges_(device.make_kernel("link_half_edges", link_half_edges_spv)),
      count_shared_(device.make_kernel("count_shared", count_shared_spv)),
      gather_shared_(device.make_kernel("gather_shared", gather_shared_spv)),
      locate_shared_(device.make_kernel("locate_shared", locate_shared_spv)),
      key_shared_(device.make_kernel("key_shared", key_shared_spv)),
      index_shared_(device.make_kernel("index_shared", index_shared_spv)),
      start_components_(device.make_kernel("start_components", start_components_spv)),
      join_components_(device.make_kernel("join_components", join_components_spv)),
      sum_topology_(device.make_kernel("sum_topology", sum_topology_spv)),
      combine_(device.make_kernel("combine_topology", combine_topology_spv)) {}

AdjacencyBuilder::Matching AdjacencyBuilder::record_matching(gpu::Recorder& recorder,
                                                             const geometry::Geometry& geometry) const {
  gpu::Device& device = recorder.device();
  const auto half_edges = static_cast<std::uint32_t>(3 * geometry.triangle_count);
  const std::uint32_t slots = edge_slots(device.info(), half_edges);
  Matching matching{.twin = gpu::Array<std::uint32_t>(device, "half-edge twins", half_edges),
                    .table = gpu::Array<std::uint32_t>(device, "edge table", slots),
                    .shared_edges = gpu::Array<std::uint32_t>(device, "shared edge count", 1)};
  recorder.fill(matching.table, kNone);
  recorder.fill(matching.shared_edges, 0);
  const HashParams hash{
      .half_edges = half_edges, .slots = slots, .slots_per_vertex = slots_per_vertex(slots, geometry)};
  recorder.run(hash_half_edges_, half_edges, hash,
               {geometry.corners, geometry.areas, matching.table, matching.twin});
  recorder.run(link_half_edges_, slots, LinkParams{slots},
               {matching.table, matching.twin, matching.shared_edges});
  return matching;
}

// Half-edges on shared edges; a pass of its own, which most batches do not need.
std::uint64_t AdjacencyBuilder::count_shared(gpu::Device& device, const Matching& matching) const {
  if (matching.shared_edges.download(device).front() == 0) return 0;
  const gpu::Array<std::uint32_t> count(device, "shared half-edge count", 1);
  const auto half_edges = static_cast<std::uint32_t>(matching.twin.count());
  gpu::Recorder recorder(device);
  recorder.fill(count, 0);
  recorder.run(count_shared_, half_edges,
               SharedParams{.count = half_edges, .slots = 0, .slots_per_vertex = 0}, {matching.twin, count});
  recorder.submit_and_wait();
  return count.download(device).front();
}

void AdjacencyBuilder::record_shared(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                     const Matching& matching, SharedEdges& shared) const {
  gpu::Device& device = recorder.device();
  const auto half_edges = static_cast<std::uint32_t>(3 * geometry.triangle_count);
  const auto slots = static_cast<std::uint32_t>(matching.table.count());
  SharedParams params{
      .count = half_edges, .slots = slots, .slots_per_vertex = slots_per_vertex(slots, geometry)};
  primitives::KeyedValues list = primitives::make_keyed_values(device, "shared half-edges", shared.count);
  const auto& cursor = recorder.keep(gpu::Array<std::uint32_t>(device, "list cursor", 1));
  recorder.fill(cursor, 0);
  recorder.run(gather_shared_, half_edges, params, {matching.twin, cursor, list.values});
  params.count = static_cast<std::uint32_t>(shared.count);
  recorder.run(locate_shared_, shared.count, params,
               {geometry.corners, matching.table, list.values, list.high});
  recorder.run(key_shared_, shared.count, params, {matching.table, list.values, list.low, list.high});
  const auto edge_bits = static_cast<std::uint32_t>(std::bit_width(half_edges));
  list = sort_.record(recorder, std::move(list), shared.count, 32 + edge_bits);
  recorder.run(index_shared_, shared.count, params,
               {list.high, list.values, shared.begins, shared.ends, matching.twin});
  recorder.keep(std::move(list.low));
  recorder.keep(std::move(list.high));
  shared.half_edges = std::move(list.values);
}

Adjacency AdjacencyBuilder::complete(gpu::Device& device, const geometry::Geometry& geometry,
                                     Matching matching) const {
  const auto triangles = static_cast<std::uint32_t>(geometry.triangle_count);
  Adjacency adjacency;
  SharedEdges& shared = adjacency.shared;
  shared.count = count_shared(device, matching);
  shared.half_edges = gpu::Array<std::uint32_t>(device, "shared half-edges", shared.count);
  shared.begins = gpu::Array<std::uint32_t>(device, "shared edge begins", shared.count);
  shared.ends = gpu::Array<std::uint32_t>(device, "shared edge ends", shared.count);
  adjacency.labels = gpu::Array<std::uint32_t>(device, "component labels", triangles);
  adjacency.totals = gpu::Array<TopologyTotals>(device, "topology totals", geometry.chunks.partial_count());

  gpu::Recorder recorder(device);
  if (shared.count > 0) record_shared(recorder, geometry, matching, shared);
  recorder.run(start_components_, triangles, TriangleParams{triangles},
               {matching.twin, shared.half_edges, adjacency.labels});
  label_sets_.record_flatten(recorder, adjacency.labels);
  recorder.run(join_components_, triangles, TriangleParams{triangles},
               {matching.twin, shared.half_edges, adjacency.labels});
  label_sets_.record_flatten(recorder, adjacency.labels);
  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.run(sum_topology_, leaves, TopologyParams{leaves},
               {geometry.chunks.leaves(), geometry.areas, matching.twin, adjacency.labels, shared.half_edges,
                adjacency.totals});
  geometry.chunks.record_combine(recorder, combine_, adjacency.totals);
  recorder.submit_and_wait();
  adjacency.twin = std::move(matching.twin);
  return adjacency;
}

}  // namespace scene_analyzer::adjacency
