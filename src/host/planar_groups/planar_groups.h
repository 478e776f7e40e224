// planar_groups.h — Groups of neighbouring triangles whose normals differ by at most alpha.
//
// Memory per triangle while it runs: normals and heights 32, labels and sizes 8; on shared edges 40 per
// half-edge. Cost: linear, and k log k on an edge with k triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "adjacency/adjacency.h"
#include "adjacency/label_sets.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/planar_groups.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"

namespace scene_analyzer::planar_groups {

struct PlanarGroups {
  gpu::Array<std::uint32_t> labels;  // per triangle: lowest triangle of its group
  gpu::Array<std::uint32_t> sizes;   // per triangle: size of the group that it is the lowest of, else 0
  gpu::Array<interface::planar_groups::PlanarTotals> totals;  // partial results of the geometry's chunks
};

class PlanarGroupBuilder {
 public:
  PlanarGroupBuilder(gpu::Device& device, const primitives::Scan& scan, const primitives::RadixSort& sort);

  // `adjacency` with indexed shared edges; alpha_degrees in [0, 180].
  PlanarGroups record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                      const adjacency::Adjacency& adjacency, double alpha_degrees) const;

 private:
  struct Normals {
    gpu::Array<double> x, y, z, heights;
  };
  const Normals& record_normals(gpu::Recorder& recorder, const geometry::Geometry& geometry) const;
  void record_shared(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                     const adjacency::SharedEdges& shared, const Normals& normals,
                     interface::planar_groups::JoinParams params,
                     const gpu::Array<std::uint32_t>& parent) const;

  const primitives::Scan& scan_;
  const primitives::RadixSort& sort_;
  adjacency::LabelSets label_sets_;
  gpu::Kernel normals_, normals_transformed_, join_coplanar_, keys_, keys_transformed_, lower_heights_, link_,
      link_transformed_, join_linked_, count_groups_, sum_groups_, combine_;
};

}  // namespace scene_analyzer::planar_groups
