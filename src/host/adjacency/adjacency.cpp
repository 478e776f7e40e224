#include "adjacency/adjacency.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "combine_topology.spv.h"
#include "gather_shared.spv.h"
#include "hash_half_edges.spv.h"
#include "index_shared.spv.h"
#include "join_components.spv.h"
#include "link_half_edges.spv.h"
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

}  // namespace

AdjacencyBuilder::AdjacencyBuilder(gpu::Device& device, const primitives::RadixSort& sort)
    : sort_(sort),
      label_sets_(device),
      hash_half_edges_(device.make_kernel("hash_half_edges", hash_half_edges_spv)),
      link_half_edges_(device.make_kernel("link_half_edges", link_half_edges_spv)),
      join_components_(device.make_kernel("join_components", join_components_spv)),
      sum_topology_(device.make_kernel("sum_topology", sum_topology_spv)),
      combine_(device.make_kernel("combine_topology", combine_topology_spv)),
      gather_shared_(device.make_kernel("gather_shared", gather_shared_spv)),
      index_shared_(device.make_kernel("index_shared", index_shared_spv)) {}

Adjacency AdjacencyBuilder::record(gpu::Recorder& recorder, const geometry::Geometry& geometry) const {
  gpu::Device& device = recorder.device();
  const auto triangles = static_cast<std::uint32_t>(geometry.triangle_count);
  const std::uint32_t half_edges = 3 * triangles;
  const std::uint32_t slots = edge_slots(device.info(), half_edges);
  Adjacency adjacency{
      .twin = gpu::Array<std::uint32_t>(device, "half-edge twins", half_edges),
      .labels = gpu::Array<std::uint32_t>(device, "component labels", triangles),
      .shared_count = gpu::Array<std::uint32_t>(device, "shared half-edge count", 1),
      .totals = gpu::Array<TopologyTotals>(device, "topology totals", geometry.chunks.partial_count()),
      .shared = {}};
  const auto& table = recorder.keep(gpu::Array<std::uint32_t>(device, "edge table", slots));
  recorder.fill(table, kNone);
  recorder.fill(adjacency.shared_count, 0);
  const HashParams hash{
      .half_edges = half_edges,
      .slots = slots,
      .slots_per_vertex = static_cast<double>(slots) / static_cast<double>(geometry.vertex_count)};
  recorder.run(hash_half_edges_, half_edges, hash, {geometry.corners, geometry.areas, table, adjacency.twin});
  recorder.run(link_half_edges_, slots, LinkParams{slots}, {table, adjacency.twin, adjacency.shared_count});

  label_sets_.record_singletons(recorder, adjacency.labels);
  recorder.run(join_components_, triangles, TriangleParams{triangles}, {adjacency.twin, adjacency.labels});
  label_sets_.record_flatten(recorder, adjacency.labels);
  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.run(
      sum_topology_, leaves, TopologyParams{leaves},
      {geometry.chunks.leaves(), geometry.areas, adjacency.twin, adjacency.labels, adjacency.totals});
  geometry.chunks.record_combine(recorder, combine_, adjacency.totals);
  return adjacency;
}

void AdjacencyBuilder::index_shared(gpu::Device& device, const geometry::Geometry& geometry,
                                    Adjacency& adjacency) const {
  SharedEdges& shared = adjacency.shared;
  shared.count = adjacency.shared_count.download(device).front();
  shared.begins = gpu::Array<std::uint32_t>(device, "shared edge begins", shared.count);
  shared.ends = gpu::Array<std::uint32_t>(device, "shared edge ends", shared.count);
  if (shared.count == 0) return;
  gpu::Recorder recorder(device);
  const auto half_edges = static_cast<std::uint32_t>(3 * geometry.triangle_count);
  primitives::KeyedValues list = primitives::make_keyed_values(device, "shared half-edges", shared.count);
  const auto& cursor = recorder.keep(gpu::Array<std::uint32_t>(device, "list cursor", 1));
  recorder.fill(cursor, 0);
  recorder.run(gather_shared_, half_edges, GatherParams{half_edges},
               {adjacency.twin, cursor, list.low, list.high, list.values});
  const auto edge_bits = static_cast<std::uint32_t>(std::bit_width(half_edges));
  list = sort_.record(recorder, std::move(list), shared.count, 32 + edge_bits);
  recorder.run(index_shared_, shared.count, SharedParams{static_cast<std::uint32_t>(shared.count)},
               {list.high, list.values, shared.begins, shared.ends, adjacency.twin});
  recorder.submit_and_wait();
  shared.half_edges = std::move(list.values);
}

}  // namespace scene_analyzer::adjacency
