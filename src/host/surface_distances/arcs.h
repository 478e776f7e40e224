// arcs.h — From the device to the host: what the search for start triangles needs of a batch.
//
// Memory: 44 bytes per triangle on the host; on the device 24 for the triangles of one window (24 MiB at
// most).
#pragma once

#include <cstdint>
#include <vector>

#include "adjacency/adjacency.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "surface_distances/dual_graph.h"

namespace scene_analyzer::surface_distances {

// A batch, read back. surface() is a view of it and of the batch's meshes.
struct BatchSurfaces {
  std::vector<double> areas;          // per triangle
  std::vector<std::uint32_t> twins;   // per half-edge
  std::vector<double> half_arcs;      // per half-edge
  std::vector<std::uint32_t> shared;  // half-edges on edges with more than two triangles
  std::vector<std::uint32_t> shared_ends;
  std::vector<interface::mesh::MeshRecord> records;

  MeshSurface surface(std::size_t mesh, const mesh::TriangleMesh& source) const;
};

class ArcMeasurer {
 public:
  explicit ArcMeasurer(gpu::Device& device);

  // Runs to completion.
  BatchSurfaces measure(gpu::Device& device, const geometry::Geometry& geometry,
                        const adjacency::Adjacency& adjacency) const;

 private:
  gpu::Kernel measure_, measure_transformed_;
};

}  // namespace scene_analyzer::surface_distances
