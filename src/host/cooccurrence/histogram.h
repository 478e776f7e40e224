// histogram.h — The co-occurrence matrix behind the contrast: how often areas meet across edges.
//
// Two views of it per mesh. Exact and sparse, for export: every pair of attributes that occurs among
// neighbours, with its count. Binned, for display: kBins x kBins counts between the lowest and the highest
// attribute. Both count ordered pairs of neighbours, so they are symmetric and add up to the sum of |N_i|.
//
// Edges with more than two triangles are counted by runs of triangles with one label (label_runs.h): an edge
// of k triangles with d distinct attributes costs k and d^2. The latter may be the size of the result; beyond
// HistogramLimits the sparse view of the mesh is refused with need and limit.
//
// Memory: 12 bytes per triangle, 56 per half-edge of edges with more than two triangles, and windows of
// bounded size. Host: 16 bytes per distinct pair of the batch.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "adjacency/adjacency.h"
#include "analysis/histogram.h"
#include "cooccurrence/area_classes.h"
#include "cooccurrence/label_runs.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"

namespace scene_analyzer::cooccurrence {

using analysis::Histogram;
using analysis::PairCount;

struct HistogramLimits {
  std::uint64_t pairs_of_mesh = std::uint64_t{1} << 24;   // from edges with more than two triangles
  std::uint64_t pairs_of_batch = std::uint64_t{1} << 26;  // the same, of meshes measured together
  std::uint32_t window = 1U << 22;                        // half-edges or pairs sorted at a time
  std::uint32_t meshes = 512;                             // binned at a time: 32 KiB each
};

// Called once per mesh of the batch, in order.
using HistogramSink = std::function<void(std::size_t mesh, Histogram histogram)>;

class HistogramBuilder {
 public:
  HistogramBuilder(gpu::Device& device, const primitives::Scan& scan, const primitives::RadixSort& sort,
                   HistogramLimits limits = {});

  // `classes` after AreaClassBuilder::limit(). Runs to completion. Cost: radix sorts of half-edges.
  void build(gpu::Device& device, const geometry::Geometry& geometry, const adjacency::Adjacency& adjacency,
             const AreaClasses& classes, const HistogramSink& sink) const;

 private:
  struct Input;
  struct Pair;
  struct Groups;
  struct PairList;

  std::vector<Pair> find_pairs(const Input& input, const Groups& groups,
                               std::vector<std::string>& refused) const;
  std::vector<std::uint32_t> refuse(const Input& input, const LabelRuns& runs,
                                    std::vector<std::string>& refused) const;
  void pair_neighbours(const Input& input, const gpu::Array<std::uint32_t>& labels, std::uint32_t label_bits,
                       std::vector<Pair>& pairs) const;
  void pair_runs(const Input& input, const LabelRuns& runs, const std::vector<std::uint32_t>& refused,
                 std::vector<Pair>& pairs) const;
  void add_up(gpu::Recorder& recorder, PairList list, std::uint32_t label_bits,
              std::vector<Pair>& pairs) const;
  std::vector<std::uint64_t> count_bins(const Input& input, const gpu::Array<std::uint32_t>& labels,
                                        const LabelRuns& runs, std::uint32_t first_mesh,
                                        std::uint32_t end_mesh) const;

  const primitives::Scan& scan_;
  const primitives::RadixSort& sort_;
  HistogramLimits limits_;
  LabelRunFinder runs_;
  gpu::Kernel bin_triangles_, group_triangles_, count_neighbour_bins_, count_run_bins_, sum_run_pairs_,
      number_run_pairs_, pair_neighbours_, pair_runs_, list_pairs_;
};

}  // namespace scene_analyzer::cooccurrence
