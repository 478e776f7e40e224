// label_runs.h — Triangles of one label on one edge with more than two triangles, as runs of a sorted list.
#pragma once

#include <cstdint>
#include <vector>

#include "adjacency/adjacency.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"

namespace scene_analyzer::cooccurrence {

// Shared half-edges sorted by edge, then label of their triangle; see shaders/compute/lib/label_runs.glsl.
struct LabelRuns {
  std::uint32_t label_bits = 1;
  std::uint32_t count = 0;                   // runs
  primitives::KeyedValues sorted;            // per shared half-edge
  gpu::Array<std::uint32_t> starts;          // per shared half-edge: runs that started before it; then all
  gpu::Array<std::uint32_t> firsts;          // per run: its first place; then the number of places
  std::vector<std::uint32_t> first_of_mesh;  // per mesh: its first run; then `count`
};

class LabelRunFinder {
 public:
  LabelRunFinder(gpu::Device& device, const primitives::Scan& scan, const primitives::RadixSort& sort);

  // `labels`: per triangle, below 2^label_bits. Runs to completion. Cost: one radix sort of shared
  // half-edges; nothing where there are none.
  LabelRuns find(gpu::Device& device, const geometry::Geometry& geometry,
                 const adjacency::SharedEdges& shared, const gpu::Array<std::uint32_t>& labels,
                 std::uint32_t label_bits) const;

  // Records into `starts` (one element more than keys) how many runs of equal keys started before each place;
  // the last element holds their number.
  void record_starts(gpu::Recorder& recorder, const primitives::KeyedValues& sorted,
                     const gpu::Array<std::uint32_t>& starts) const;

 private:
  const primitives::Scan& scan_;
  const primitives::RadixSort& sort_;
  gpu::Kernel key_labels_, mark_starts_, list_runs_, locate_meshes_;
};

}  // namespace scene_analyzer::cooccurrence
