// defect_finder.h — What is wrong with the meshes of a batch; docs/metrics.md defines the kinds.
//
// Cost: linear in triangles and vertices, whatever is wrong with them; places are read back only as far as
// the first few of each kind. Memory while it runs: 1.4 bytes per triangle and 1 per vertex; on edges with
// more than two triangles 2.7 per half-edge.
#pragma once

#include <vector>

#include "adjacency/adjacency.h"
#include "analysis/defects.h"
#include "geometry/chunk_tree.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/defects.h"

namespace scene_analyzer::defects {

// On the device after record() has run: per chunk what find_*_defects.comp found.
struct ChunkDefects {
  geometry::ChunkTree vertex_chunks;
  gpu::Array<interface::defects::TriangleDefects>
      triangle_totals;                                           // partial results of the geometry's chunks
  gpu::Array<interface::defects::TriangleMasks> triangle_masks;  // per leaf of them
  gpu::Array<interface::defects::VertexDefects> vertex_totals;   // partial results of vertex_chunks
  gpu::Array<interface::defects::VertexMasks> vertex_masks;      // per leaf of them
};

class DefectFinder {
 public:
  explicit DefectFinder(gpu::Device& device);

  // `adjacency` with indexed shared edges; `geometry` with what welding noted of its vertices.
  ChunkDefects record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                      const adjacency::Adjacency& adjacency) const;

 private:
  gpu::Kernel hash_triangles_, find_triangle_defects_, combine_triangle_defects_, find_vertex_defects_,
      combine_vertex_defects_;
};

// Per mesh of the batch, after the recording has run. Two runs give the same.
std::vector<analysis::Defects> read_defects(gpu::Device& device, const geometry::Geometry& geometry,
                                            const ChunkDefects& chunks);

}  // namespace scene_analyzer::defects
