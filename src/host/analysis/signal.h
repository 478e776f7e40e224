// signal.h — The signal of one geometry and its spectrum, for export; views of the producer's arrays.
#pragma once

#include <span>

namespace scene_analyzer::analysis {

struct SignalSpectrum {
  std::span<const double> areas;  // N of them, in analysed coordinates, by distance from the start triangle
  std::span<const double> magnitudes;  // |X_0| .. |X_c|, c = floor(N / 2); empty where N = 0
};

}  // namespace scene_analyzer::analysis
