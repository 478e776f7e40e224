// area_classes.h — Which areas are one value, and the limit on how many values there may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scene_analyzer::reference {

// Classes are numbered by ascending area.
struct AreaClasses {
  std::vector<std::uint32_t> class_of;  // per triangle; kNone when not kept
  std::vector<double> value;            // per class: the attribute A of its triangles
};

// Areas that differ by at most 1.19209e-07 relative to the larger are one value: a class starts at a value
// and takes those within that distance of it; its smallest area is its value. n log n.
AreaClasses distinct_areas(std::span<const double> areas, std::span<const std::uint8_t> kept);

// Joins neighbouring groups of ascending distinct `values` until `dim` remain; returns the first value of
// each group. Each step takes the two neighbours whose union has the least sum |value - mean of the union|,
// rounded to 20 significant bits (half to even); ties to the lower pair. Nothing is joined when there are no
// more than `dim`. dim >= 1. n log^2 n.
std::vector<std::uint32_t> merge_classes(std::span<const double> values, std::size_t dim);

// The same by scanning all pairs in every step and summing every union: the twin's own oracle, for small
// inputs.
std::vector<std::uint32_t> merge_classes_naive(std::span<const double> values, std::size_t dim);

// Both steps: at most `dim` classes, each member of a joined group counting with the mean of the group's
// values.
AreaClasses area_classes(std::span<const double> areas, std::span<const std::uint8_t> kept, std::size_t dim);

}  // namespace scene_analyzer::reference
