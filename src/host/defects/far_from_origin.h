// far_from_origin.h — Whether float32 coordinates are too coarse for a shape where it lies.
#pragma once

#include <array>

namespace scene_analyzer::defects {

// Neighbouring values of float32 lie 2^(e - 23) apart, e = floor(log2 |x|). A shape whose largest side has
// fewer steps than this is known to less than a thousandth of its size.
inline constexpr double kLeastSteps = 1024;

// Whether the largest side of the box is shorter than kLeastSteps steps at its largest coordinate. Finite,
// low <= high. False at the origin itself.
bool is_far_from_origin(const std::array<float, 3>& low, const std::array<float, 3>& high);

}  // namespace scene_analyzer::defects
