// spectrum.h — Magnitudes of the discrete Fourier transforms of many real signals, on the device, in double
// precision.
//
// X_k = sum over n of x_n exp(-2 pi i k n / N), for k in 0..c with c = floor(N / 2), of signals of any length
// N up to kLongestSignal. Totals of |X_k| within 1e-9 of the exact ones, relative to the largest |X_k|; in
// fact some 1e-14. The same signals on the same device give the same bits, whatever other signals are with
// them.
//
// Short signals are summed directly, N^2 each; longer ones go through a chirp transform (chirp_transform.h)
// around plans for a few powers of two, n log n, in batches of signals of similar length.
//
// Memory: batches of some 40 MB. A signal whose row of the chirp transform is longer than
// SpectrumLimits::batch / 2 goes alone, with 32 bytes per element of the row (N to 1.5 N for even N, 1.5 N
// to 2.25 N for odd N), 8 per sample, and as many on the host. Between calls 0.4 MiB of tables stay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "gpu/device.h"

namespace scene_analyzer::spectrum {

inline constexpr std::uint64_t kLongestSignal = std::uint64_t{1} << 24;  // samples

struct SpectrumTotals {
  double zero = 0;          // |X_0|
  double largest = 0;       // max over k = 1..c of |X_k|; 0 when N < 2, like the two below
  double sum = 0;           // sum over k = 1..c of |X_k|
  double weighted_sum = 0;  // sum over k = 1..c of k |X_k|
};

// Called once per signal that is not empty, in no particular order, with |X_0| .. |X_c|, which are gone
// afterwards.
using MagnitudeSink = std::function<void(std::size_t signal, std::span<const double> magnitudes)>;

// The defaults are the fastest where this was measured; results do not depend on them by more than rounding.
struct SpectrumLimits {
  std::uint32_t short_samples = 256;       // the longest signal that is summed directly; at most 2^12
  std::uint32_t batch = 1U << 20;          // complex numbers transformed at a time
  std::uint64_t longest = kLongestSignal;  // at most that
  std::uint32_t window = 1U << 23;  // complex numbers per buffer: a power of two, at least 2^12; lowered to
                                    // what the device can bind
};

class ShortTransform;
class ChirpTransform;

// Made once per device, which outlives it; kernels and plans are made when they are first needed.
class SpectrumBuilder {
 public:
  // Throws std::logic_error for limits that cannot be.
  explicit SpectrumBuilder(gpu::Device& device, SpectrumLimits limits = {});
  ~SpectrumBuilder();

  // One result per signal, in their order. Samples are finite. Runs to completion. Throws gpu::OutOfMemory
  // with need and limit, also for a signal beyond the longest, and DeviceLost.
  std::vector<SpectrumTotals> transform(std::span<const std::span<const double>> signals,
                                        const MagnitudeSink& magnitudes = {});

 private:
  gpu::Device& device_;
  SpectrumLimits limits_;
  std::unique_ptr<ShortTransform> short_;
  std::unique_ptr<ChirpTransform> chirp_;
};

}  // namespace scene_analyzer::spectrum
