// chunk_tree.h — How per-triangle values become per-mesh results: chunks of triangles, chunks of chunks, one
// result per mesh.
//
// Level 0 cuts the triangles of each mesh into runs of kChunkSize; every further level cuts the results of
// the level below the same way, until the last has exactly one entry per mesh, in mesh order. One thread adds
// up one chunk in order, so sums do not depend on scheduling.
//
// Partial results of all levels share one array; every level begins at a multiple of
// 32 entries, so that it can be bound alone whatever alignment a device asks for (at most 256 bytes).
//
// What is said of triangles holds for vertices where the tree was made of their ranges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/geometry.h"
#include "interface/mesh.h"

namespace scene_analyzer::geometry {

class ChunkTree {
 public:
  struct Range {
    std::uint32_t first, count;
  };

  ChunkTree() = default;
  // `ranges`: the triangles or the vertices of each mesh, at least one each. Cost: linear in their number /
  // kChunkSize + meshes.
  ChunkTree(gpu::Device& device, std::vector<Range> ranges);

  std::uint64_t leaf_count() const { return sizes_.front(); }     // chunks of triangles
  std::uint64_t partial_count() const { return partial_count_; }  // entries of a partial-result array
  std::uint64_t mesh_count() const { return sizes_.back(); }
  std::uint64_t result_offset() const { return offsets_.back(); }  // where the per-mesh results begin
  const gpu::Array<interface::mesh::Chunk>& leaves() const { return levels_.front(); }
  // Level 1, chunks of chunks: always there. Those of one mesh follow each other.
  const gpu::Array<interface::mesh::Chunk>& blocks() const { return levels_[1]; }
  std::uint32_t block_offset() const { return offsets_[1]; }
  Range blocks_of(std::size_t mesh) const { return blocks_of_[mesh]; }

  // Records the levels above the leaves: `combine` binds {chunks, partials}.
  template <typename Totals>
  void record_combine(gpu::Recorder& recorder, const gpu::Kernel& combine,
                      const gpu::Array<Totals>& partials) const {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      const interface::geometry::CombineParams params {
        .chunk_count = sizes_[level], .first_input = offsets_[level - 1], .first_output = offsets_[level]
      };
      recorder.run(combine, sizes_[level], params, {levels_[level], partials});
    }
  }

  template <typename Totals>
  gpu::BufferRange result_range(const gpu::Array<Totals>& partials) const {
    return {partials.buffer(), result_offset() * sizeof(Totals), mesh_count() * sizeof(Totals)};
  }

  // The per-mesh results of a partial-result array, after its recording has run.
  template <typename Totals>
  std::vector<Totals> results(gpu::Device& device, const gpu::Array<Totals>& partials) const {
    return partials.download(device, result_offset(), mesh_count());
  }

 private:
  std::vector<gpu::Array<interface::mesh::Chunk>> levels_;
  std::vector<std::uint32_t> sizes_, offsets_;
  std::vector<Range> blocks_of_;
  std::uint64_t partial_count_ = 0;
};

std::vector<ChunkTree::Range> triangle_ranges(std::span<const interface::mesh::MeshRecord> records);
std::vector<ChunkTree::Range> vertex_ranges(std::span<const interface::mesh::MeshRecord> records);

}  // namespace scene_analyzer::geometry
