// adjacency.h — Which triangles share an edge, and what hangs together through edges.
//
// Memory per triangle: twins 12, labels 4; while edges are matched also 15 for the hash table. Edges with
// more than two triangles cost their number of triangles, never its square.
#pragma once

#include <cstdint>
#include <vector>

#include "adjacency/label_sets.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/adjacency.h"
#include "primitives/radix_sort.h"

namespace scene_analyzer::adjacency {

// Half-edges on edges with more than two triangles, grouped by edge; `count` may be 0.
struct SharedEdges {
  std::uint64_t count = 0;                 // half-edges
  gpu::Array<std::uint32_t> half_edges;    // sorted by edge, then index
  gpu::Array<std::uint32_t> begins, ends;  // per entry: the range of its edge
};

struct Adjacency {
  gpu::Array<std::uint32_t> twin;                           // per half-edge, see interface/adjacency.h
  gpu::Array<std::uint32_t> labels;                         // per triangle: lowest triangle of its component
  gpu::Array<interface::adjacency::TopologyTotals> totals;  // partial results of the geometry's chunks
  SharedEdges shared;
};

class AdjacencyBuilder {
 public:
  AdjacencyBuilder(gpu::Device& device, const primitives::RadixSort& sort);

  // What matching leaves for complete(): sizes of the rest depend on the data.
  struct Matching {
    gpu::Array<std::uint32_t> twin;
    gpu::Array<std::uint32_t> table;
    gpu::Array<std::uint32_t> shared_edges;  // one element: edges with more than two triangles
  };

  // Records the search for half-edges that meet, to be run in one go with the geometry's recording.
  Matching record_matching(gpu::Recorder& recorder, const geometry::Geometry& geometry) const;

  // To be called once record_matching() has run: lists shared edges, if there are any, labels components and
  // adds up. Runs to completion.
  Adjacency complete(gpu::Device& device, const geometry::Geometry& geometry, Matching matching) const;

 private:
  std::uint64_t count_shared(gpu::Device& device, const Matching& matching) const;
  void record_shared(gpu::Recorder& recorder, const geometry::Geometry& geometry, const Matching& matching,
                     SharedEdges& shared) const;

  const primitives::RadixSort& sort_;
  LabelSets label_sets_;
  gpu::Kernel hash_half_edges_, link_half_edges_, count_shared_, gather_shared_, locate_shared_, key_shared_,
      index_shared_, start_components_, join_components_, sum_topology_, combine_;
};

}  // namespace scene_analyzer::adjacency
