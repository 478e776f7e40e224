// weld_tolerance.h — Which vertices are one vertex when small distances do not count. On the host, once per
// upload.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scene_analyzer::geometry {

// For each vertex the lowest index of its cluster: vertices within `tolerance` of each other (Euclidean,
// local units, squared distances compared in double), and whatever is linked through others. A vertex with a
// NaN or an infinity stays alone. `positions`: x, y, z per vertex, fewer than 2^32 of them; tolerance > 0,
// infinity included. Throws std::invalid_argument otherwise.
//
// Cost: sorting, n log n, however vertices and tolerance relate (all in one place, tolerance beyond the mesh
// or below the spacing of floats): what lies in one cell of a grid is one cluster unseen, and two
// neighbouring cells are compared through box trees, at most once and only while they are not linked yet.
// Shapes made against the trees (a ring whose radius is the tolerance to six digits, and its axis) take
// n^1.5. About 80 bytes per vertex at worst.
std::vector<std::uint32_t> weld_within(std::span<const float> positions, double tolerance);

}  // namespace scene_analyzer::geometry
