// contrast.h — R_ccm's sum: how much the areas of neighbours differ, without the dense matrix.
//
// Cost: linear. Memory: 8 bytes per chunk of triangles, 24 per half-edge on edges with more than two
// triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "adjacency/adjacency.h"
#include "cooccurrence/area_classes.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "primitives/scan.h"

namespace scene_analyzer::cooccurrence {

class ContrastSummer {
 public:
  ContrastSummer(gpu::Device& device, const primitives::Scan& scan);

  // Partial results of the geometry's chunks. Per mesh: the sum over triangles of the mean squared difference
  // to their neighbours' attributes, with attributes carried to [0,1]; divided by the number of triangles
  // that have a neighbour it is the rating. 0 for meshes uniform to float precision. `classes` after
  // AreaClassBuilder::limit().
  gpu::Array<double> record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                            const adjacency::Adjacency& adjacency, const AreaClasses& classes) const;

 private:
  const primitives::Scan& scan_;
  gpu::Kernel list_shared_, sum_, combine_;
};

}  // namespace scene_analyzer::cooccurrence
