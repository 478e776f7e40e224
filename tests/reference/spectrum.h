// spectrum.h — Magnitudes of a discrete Fourier transform, summed term by term in long double.
#pragma once

#include <span>
#include <vector>

namespace scene_analyzer::reference {

struct Spectrum {
  std::vector<double> magnitudes;  // |X_0| .. |X_c|, c = floor(N / 2); empty without samples
  double zero = 0;                 // |X_0|
  double largest = 0;              // over k = 1..c of |X_k|, as the sums are
  double sum = 0;
  double weighted_sum = 0;  // of k |X_k|
};

// N^2 time: for up to some thousand samples.
Spectrum spectrum(std::span<const double> samples);
// The totals of magnitudes that were found elsewhere.
Spectrum totals_of(std::vector<double> magnitudes);

}  // namespace scene_analyzer::reference
