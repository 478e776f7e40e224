// weld.h — Which vertices are one vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scene_analyzer::reference {

// The lowest index of each vertex's class. `positions`: x, y, z per vertex, local coordinates.
// Tolerance 0: vertices with equal coordinates (-0 equals 0); one with a NaN represents itself. Linear.
// Tolerance > 0: also those within that Euclidean distance, transitively. Every pair is looked at: for small
// inputs only.
std::vector<std::uint32_t> weld(std::span<const float> positions, double tolerance = 0);

}  // namespace scene_analyzer::reference
