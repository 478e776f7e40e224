#include "geometry/chunk_tree.h"

#include <algorithm>
#include <string>

namespace scene_analyzer::geometry {
namespace {

using interface::mesh::Chunk;
using interface::mesh::kChunkSize;

constexpr std::uint64_t kLevelAlignment = 32;  // entries

// Consecutive entries of one mesh at some level.
using Run = ChunkTree::Range;

std::vector<Chunk> cut(std::vector<Run>& runs) {
  std::vector<Chunk> chunks;
  for (std::uint32_t mesh = 0; mesh < runs.size(); ++mesh) {
    Run& run = runs[mesh];
    const auto begin = static_cast<std::uint32_t>(chunks.size());
    for (std::uint32_t done = 0; done < run.count; done += kChunkSize)
      chunks.push_back(
          {.first = run.first + done, .count = std::min(kChunkSize, run.count - done), .mesh = mesh});
    run = {.first = begin, .count = static_cast<std::uint32_t>(chunks.size()) - begin};
  }
  return chunks;
}

}  // namespace

std::vector<ChunkTree::Range> triangle_ranges(std::span<const interface::mesh::MeshRecord> records) {
  std::vector<ChunkTree::Range> ranges;
  for (const auto& record : records) ranges.push_back({record.first_triangle, record.triangle_count});
  return ranges;
}

std::vector<ChunkTree::Range> vertex_ranges(std::span<const interface::mesh::MeshRecord> records) {
  std::vector<ChunkTree::Range> ranges;
  for (const auto& record : records) ranges.push_back({record.first_vertex, record.vertex_count});
  return ranges;
}

ChunkTree::ChunkTree(gpu::Device& device, std::vector<Range> runs) {
  const auto single = [](const Run& run) { return run.count == 1; };
  do {
    const std::vector<Chunk> chunks = cut(runs);
    if (levels_.size() == 1) blocks_of_ = runs;
    levels_.emplace_back(device, "chunks of level " + std::to_string(levels_.size()), chunks.size());
    levels_.back().upload(device, chunks);
    offsets_.push_back(static_cast<std::uint32_t>(partial_count_));
    sizes_.push_back(static_cast<std::uint32_t>(chunks.size()));
    partial_count_ += (chunks.size() + kLevelAlignment - 1) / kLevelAlignment * kLevelAlignment;
  } while (levels_.size() < 2 || !std::all_of(runs.begin(), runs.end(), single));
}

}  // namespace scene_analyzer::geometry
