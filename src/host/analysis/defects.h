// defects.h — What is wrong with a mesh: kinds, how often each occurs, and where. docs/metrics.md defines
// them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace scene_analyzer::analysis {

// In this order everywhere.
enum class Defect : std::uint8_t {
  kDegenerateByIndex,     // triangles with two equal welded corners
  kDegenerateByShape,     // triangles with three different corners and no usable area, or not finite
  kDuplicateTriangles,    // triangles with the corners of an earlier one, in any order
  kNonManifoldEdges,      // edges with more than two triangles
  kBoundaryEdges,         // edges with one triangle
  kInconsistentWinding,   // edges that both of their two triangles run along in the same direction
  kIsolatedTriangles,     // triangles without a neighbour
  kUnreferencedVertices,  // vertices that no triangle uses
  kNonFiniteVertices,     // vertices with a coordinate that is infinite or not a number
  kMergeableVertices,     // vertices less distinct positions
  kZeroArea,              // 1: no triangle has an area
  kFarFromOrigin          // 1: float32 has too few steps for the shape where it lies
};
inline constexpr std::size_t kDefectCount = 12;

inline constexpr std::size_t index_of(Defect defect) {
  return static_cast<std::size_t>(defect);
}

// The names in JSON and CSV.
inline constexpr std::array<std::string_view, kDefectCount> kDefectKeys = {
    "degenerate_by_index", "degenerate_by_shape",  "duplicate_triangles", "non_manifold_edges",
    "boundary_edges",      "inconsistent_winding", "isolated_triangles",  "unreferenced_vertices",
    "non_finite_vertices", "mergeable_vertices",   "zero_area",           "far_from_origin"};

// What the places of a defect are. Those of an edge are the lowest triangle on it.
enum class DefectPlace : std::uint8_t { kTriangle, kVertex, kNone };

inline constexpr DefectPlace place_of(Defect defect) {
  if (defect <= Defect::kIsolatedTriangles) return DefectPlace::kTriangle;
  return defect <= Defect::kMergeableVertices ? DefectPlace::kVertex : DefectPlace::kNone;
}

inline constexpr std::size_t kMostDefectPlaces = 8;

struct FoundDefect {
  Defect defect = Defect::kDegenerateByIndex;
  std::uint64_t count = 0;            // at least 1
  std::vector<std::uint32_t> places;  // the lowest ones, ascending: indices in the asset's mesh
  bool operator==(const FoundDefect&) const = default;
};

// All defects of one geometry, those that it has not left out.
struct Defects {
  std::vector<FoundDefect> found;  // each kind at most once, in the order of the kinds

  const FoundDefect* find(Defect defect) const {
    const auto one = std::ranges::find(found, defect, &FoundDefect::defect);
    return one == found.end() ? nullptr : &*one;
  }
  std::uint64_t count(Defect defect) const {
    const FoundDefect* one = find(defect);
    return one == nullptr ? 0 : one->count;
  }
  bool operator==(const Defects&) const = default;
};

}  // namespace scene_analyzer::analysis
