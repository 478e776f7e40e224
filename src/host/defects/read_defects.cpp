// read_defects.cpp — Counts and masks of chunks become counts and places of meshes, on the host.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "defects/defect_finder.h"
#include "defects/far_from_origin.h"

namespace scene_analyzer::defects {
namespace {

using namespace interface::defects;
using analysis::Defect;
using analysis::FoundDefect;
using interface::mesh::kChunkSize;

constexpr std::uint64_t kWindow = 4096;  // chunks read back at once
constexpr auto kFirstVertexKind = static_cast<std::size_t>(Defect::kUnreferencedVertices);
static_assert(kFirstVertexKind == kTriangleKinds);
static_assert(static_cast<std::size_t>(Defect::kZeroArea) == kTriangleKinds + kVertexKinds);
static_assert(kChunkSize == 32 * kMaskWords);

// Masks of chunks in ascending order, of which most are never asked for.
template <typename Masks>
class MaskReader {
 public:
  MaskReader(gpu::Device& device, const gpu::Array<Masks>& masks) : device_(device), masks_(masks) {}

  const Masks& at(std::uint64_t chunk) {
    if (chunk >= first_ + window_.size()) {
      first_ = chunk;
      window_ = masks_.download(device_, first_, std::min(kWindow, masks_.count() - first_));
    }
    return window_[chunk - first_];
  }

 private:
  gpu::Device& device_;
  const gpu::Array<Masks>& masks_;
  std::uint64_t first_ = 0;
  std::vector<Masks> window_;
};

// The set bits of one kind, as long as places are missing. `offset`: where the chunk begins in its mesh.
void append_places(std::span<const std::uint32_t> words, std::uint32_t offset, FoundDefect& defect) {
  for (const std::uint32_t word : words) {
    for (std::uint32_t bits = word; bits != 0 && defect.places.size() < analysis::kMostDefectPlaces;
         bits &= bits - 1)
      defect.places.push_back(offset + static_cast<std::uint32_t>(std::countr_zero(bits)));
    offset += 32;
  }
}

// Adds the kinds from `first_kind` on that were counted. `chunks`: how many the mesh has, from `first_chunk`
// on.
template <typename Totals, typename Masks>
void add_defects(const Totals& totals, std::size_t first_kind, std::uint64_t first_chunk,
                 std::uint64_t chunks, MaskReader<Masks>& masks, analysis::Defects& defects) {
  const std::size_t before = defects.found.size();
  for (std::size_t kind = 0; kind < totals.counts.size(); ++kind)
    if (totals.counts[kind] > 0)
      defects.found.push_back(
          {.defect = static_cast<Defect>(first_kind + kind), .count = totals.counts[kind], .places = {}});
  const std::span added = std::span(defects.found).subspan(before);
  // Several edges may begin at one triangle, so that there are fewer places than edges.
  const auto wants_more = [](const FoundDefect& one) {
    return one.places.size() < std::min<std::uint64_t>(one.count, analysis::kMostDefectPlaces);
  };
  for (std::uint64_t chunk = 0; chunk < chunks && std::ranges::any_of(added, wants_more); ++chunk) {
    const auto& words = masks.at(first_chunk + chunk).words;
    for (FoundDefect& one : added) {
      const std::size_t kind = static_cast<std::size_t>(one.defect) - first_kind;
      append_places(std::span(words).subspan(kMaskWords * kind, kMaskWords),
                    static_cast<std::uint32_t>(kChunkSize * chunk), one);
    }
  }
}

std::array<float, 3> coordinates(const std::array<std::uint32_t, 3>& ordered) {
  std::array<float, 3> result{};
  std::ranges::transform(ordered, result.begin(), [](std::uint32_t bits) {
    return std::bit_cast<float>((bits & 0x80000000u) != 0 ? bits & 0x7FFFFFFFu : ~bits);
  });
  return result;
}

void add_defects_of_the_whole(const TriangleDefects& triangles, const VertexDefects& vertices,
                              std::uint32_t triangle_count, analysis::Defects& defects) {
  const std::uint64_t degenerate = std::uint64_t{triangles.counts[0]} + triangles.counts[1];
  if (degenerate == triangle_count)
    defects.found.push_back({.defect = Defect::kZeroArea, .count = 1, .places = {}});
  const bool has_place = vertices.low[0] <= vertices.high[0];
  if (has_place && is_far_from_origin(coordinates(vertices.low), coordinates(vertices.high)))
    defects.found.push_back({.defect = Defect::kFarFromOrigin, .count = 1, .places = {}});
}

}  // namespace

bool is_far_from_origin(const std::array<float, 3>& low, const std::array<float, 3>& high) {
  double extent = 0, farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent = std::max(extent, double{high[axis]} - double{low[axis]});
    farthest = std::max({farthest, std::abs(double{high[axis]}), std::abs(double{low[axis]})});
  }
  if (farthest == 0) return false;
  const double spacing = std::ldexp(1.0, std::ilogb(farthest) - 23);
  return extent < kLeastSteps * spacing;
}

std::vector<analysis::Defects> read_defects(gpu::Device& device, const geometry::Geometry& geometry,
                                            const ChunkDefects& chunks) {
  const auto triangles = geometry.chunks.results(device, chunks.triangle_totals);
  const auto vertices = chunks.vertex_chunks.results(device, chunks.vertex_totals);
  MaskReader triangle_masks(device, chunks.triangle_masks);
  MaskReader vertex_masks(device, chunks.vertex_masks);
  std::vector<analysis::Defects> result(geometry.records.size());
  std::uint64_t triangle_chunk = 0, vertex_chunk = 0;
  for (std::size_t mesh = 0; mesh < result.size(); ++mesh) {
    const auto chunks_of = [](std::uint64_t count) { return (count + kChunkSize - 1) / kChunkSize; };
    const std::uint64_t of_triangles = chunks_of(geometry.records[mesh].triangle_count);
    const std::uint64_t of_vertices = chunks_of(geometry.records[mesh].vertex_count);
    add_defects(triangles[mesh], 0, triangle_chunk, of_triangles, triangle_masks, result[mesh]);
    add_defects(vertices[mesh], kFirstVertexKind, vertex_chunk, of_vertices, vertex_masks, result[mesh]);
    add_defects_of_the_whole(triangles[mesh], vertices[mesh], geometry.records[mesh].triangle_count,
                             result[mesh]);
    triangle_chunk += of_triangles;
    vertex_chunk += of_vertices;
  }
  return result;
}

}  // namespace scene_analyzer::defects
