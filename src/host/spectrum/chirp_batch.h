// chirp_batch.h — What the kernels of the chirp transform need to know of signals whose rows have one form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/device.h"
#include "interface/spectrum.h"
#include "spectrum/row_convolution.h"
#include "spectrum/signal_batch.h"

namespace scene_analyzer::spectrum {

inline bool is_even(const Signal& signal) {
  return signal.samples.size() % 2 == 0;
}
// Numbers that the chirp transform sees.
std::uint32_t size_of(const Signal& signal);
// Lags that its row has to keep apart.
std::uint64_t lags_of(const Signal& signal);

class ChirpBatch {
 public:
  explicit ChirpBatch(Results results) : batch_(results) {}

  // The rows taken if the signal were added: one per signal, one per length.
  std::size_t rows_with(const Signal& signal) const;
  // Signals of equal length come one behind the other.
  void add(const Signal& signal);

  std::uint32_t signal_count() const { return static_cast<std::uint32_t>(signals_.size()); }
  std::uint32_t chirp_count() const { return static_cast<std::uint32_t>(chirps_.size()); }

  struct OnDevice {
    gpu::Array<double> samples, magnitudes;
    gpu::Array<interface::spectrum::ChirpSignal> signals, chirps;
    ComplexArray phases;
    gpu::Array<interface::spectrum::Segment> segments;
    gpu::Array<interface::spectrum::SpectrumPart> parts;
  };
  // `first_chirp`: the row of the first chirp among those that signals name.
  OnDevice upload(gpu::Device& device, std::uint32_t first_chirp) const;
  void finish(gpu::Device& device, const OnDevice& arrays) const {
    batch_.finish(device, arrays.parts, arrays.magnitudes);
  }
  bool wants_magnitudes() const { return batch_.wants_magnitudes(); }

 private:
  void add_chirp(std::uint32_t size);

  SignalBatch batch_;
  std::vector<interface::spectrum::ChirpSignal> signals_, chirps_;
  std::vector<Complex> phases_;
};

}  // namespace scene_analyzer::spectrum
