// signal_batch.h — Signals on their way to the device, and what comes back.
//
// A signal is scaled by a power of two and moved by its mean, so that neither large nor small values leave
// the range of squares, and so that nearly constant signals keep all digits of what alternates. Only X_0 has
// to be put right again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "interface/spectrum.h"
#include "spectrum/spectrum.h"

namespace scene_analyzer::spectrum {

// A signal, or its place among all that were asked for.
struct Signal {
  std::size_t index = 0;
  std::span<const double> samples;
};

// Where results go.
struct Results {
  std::span<SpectrumTotals> totals;  // per signal
  const MagnitudeSink& sink;
};

class SignalBatch {
 public:
  explicit SignalBatch(Results results) : results_(results) {}

  // Appends the signal, and zeros up to a multiple of `padding` samples. Returns where it begins.
  std::uint32_t add_samples(const Signal& signal, std::uint32_t padding);
  // Appends room for magnitudes 0..c, where somebody wants them. Returns where it begins.
  std::uint32_t add_magnitudes(const Signal& signal);
  // Appends segments of at most `most` frequencies (or pairs) each of the signal added last, `count` in all.
  void add_segments(std::uint32_t count, std::uint32_t most);

  gpu::Array<double> upload_samples(gpu::Device& device) const;
  gpu::Array<interface::spectrum::Segment> upload_segments(gpu::Device& device) const;
  // For the kernels that add up.
  gpu::Array<interface::spectrum::SpectrumPart> make_parts(gpu::Device& device) const;
  gpu::Array<double> make_magnitudes(gpu::Device& device) const;

  std::span<const interface::spectrum::Segment> segments() const { return segments_; }
  bool wants_magnitudes() const { return static_cast<bool>(results_.sink); }
  std::uint64_t sample_count() const { return samples_.size(); }

  // Adds up what the device found for the segments, in their order, and hands it on.
  void finish(gpu::Device& device, const gpu::Array<interface::spectrum::SpectrumPart>& parts,
              const gpu::Array<double>& magnitudes) const;

 private:
  struct Entry {
    std::size_t index = 0;
    std::uint64_t size = 0;  // samples
    int exponent = 0;        // sample = 2^exponent (value on the device + mean)
    double mean = 0;
    std::uint32_t first_magnitude = 0;
  };

  Results results_;
  std::vector<Entry> entries_;
  std::vector<double> samples_;
  std::vector<interface::spectrum::Segment> segments_;
  std::uint64_t magnitude_count_ = 0;
};

}  // namespace scene_analyzer::spectrum
