// cooccurrence.h — How much neighbours differ in area: the contrast, and the matrix behind it as histograms.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "reference/adjacency.h"
#include "reference/area_classes.h"

namespace scene_analyzer::reference {

struct Contrast {
  double rating = 0;              // R_ccm, [0,1]
  std::uint64_t neighboured = 0;  // n': triangles that have a neighbour
};

// Linear: an edge of k triangles costs k.
Contrast cooccurrence_contrast(const Adjacency& adjacency, const AreaClasses& classes);

// Ordered pairs of neighbours by (class, class); symmetric. An edge costs the square of the number of
// distinct classes on it, which is what the result may hold.
using ClassPairs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t>;
ClassPairs count_class_pairs(const Adjacency& adjacency, const AreaClasses& classes);

inline constexpr std::uint32_t kBins = 64;
// Row-major. Bin = floor(64 (A - min) / (max - min)), the largest value in bin 63; all in bin 0 for uniform
// meshes.
using BinnedPairs = std::array<std::uint64_t, std::size_t{kBins} * kBins>;
BinnedPairs count_binned_pairs(const Adjacency& adjacency, const AreaClasses& classes);

}  // namespace scene_analyzer::reference
