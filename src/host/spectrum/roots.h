// roots.h — Roots of unity for tables: exact to the last bits, whatever their index.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

namespace scene_analyzer::spectrum {

using Complex = std::complex<double>;  // as GLSL's dvec2

// exp(-2 pi i j / n). The angle is reduced to an eighth of the circle in integers. 8 j must not overflow.
Complex root_of_unity(std::uint64_t j, std::uint64_t n);

// Appends exp(-2 pi i j / n) for every j in [0, n).
void append_roots(std::vector<Complex>& table, std::uint32_t n);

// Appends two tables out of which every exp(-2 pi i j / n) is one product: 2^fine_bits entries for the lower
// bits of j, then those for the upper ones.
void append_split_roots(std::vector<Complex>& table, std::uint32_t n, std::uint32_t fine_bits);

}  // namespace scene_analyzer::spectrum
