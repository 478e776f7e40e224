// histogram.h — How often areas meet across edges, for one geometry: the matrix behind the co-occurrence
// contrast.
//
// Counts are of ordered pairs (i, j) of neighbours: symmetric, and their sum is the sum of all triangles'
// neighbours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scene_analyzer::analysis {

inline constexpr std::uint32_t kHistogramBins = 64;  // per axis

struct PairCount {
  std::uint32_t row = 0, column = 0;  // indices into Histogram::values
  std::uint64_t count = 0;            // at least 1
  bool operator==(const PairCount&) const = default;
};

struct Histogram {
  std::vector<double> values;       // distinct attributes (areas, or means of merged ones), ascending
  std::vector<PairCount> pairs;     // ascending by row, then column; empty when refused
  std::string refused;              // why the pairs are missing, with need and limit; or empty
  std::vector<std::uint64_t> bins;  // kHistogramBins x kHistogramBins, row-major, between the lowest and the
                                    // highest value; empty only where `refused` says that memory ran out
};

}  // namespace scene_analyzer::analysis
