// distance_types.h — In what distances are counted: double, or whole units for bounds.
//
// Bounds may be too high, never too low. So their searches count in whole units, lengths rounded up: sums and
// comparisons are exact, and 16 distances fit one cache line.
#pragma once

#include <cstdint>
#include <limits>

// The widest vectors that the processor has, chosen when the program starts. Results do not depend on it:
// lanes are added, multiplied and compared one by one, and nothing is fused (-ffp-contract=off).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

namespace scene_analyzer::surface_distances {

using Units = std::uint32_t;

template <typename Distance>
struct DistanceTraits;

template <>
struct DistanceTraits<double> {
  using Sum = double;
  static constexpr double kUnreached = std::numeric_limits<double>::infinity();
};

// Two of the largest add up without a carry. An arc of kUnreached is never followed.
template <>
struct DistanceTraits<Units> {
  using Sum = std::uint64_t;
  static constexpr Units kUnreached = std::numeric_limits<std::int32_t>::max();
};

template <typename Distance>
inline constexpr Distance kUnreached = DistanceTraits<Distance>::kUnreached;

template <typename Distance>
using SumOf = typename DistanceTraits<Distance>::Sum;

}  // namespace scene_analyzer::surface_distances
