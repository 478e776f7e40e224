// short_transform.h — Spectra of short signals, summed directly: many in one dispatch, N^2 each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "spectrum/signal_batch.h"

namespace scene_analyzer::spectrum {

class ShortTransform {
 public:
  explicit ShortTransform(gpu::Device& device);

  // Signals of at least one sample, some `batch` samples at a time. Runs to completion. Memory: 8 bytes per
  // sample of a batch and 16 per sample of every length that occurs in it.
  void run(std::vector<Signal> signals, std::uint32_t batch, Results results);

 private:
  std::size_t run_batch(std::span<const Signal> signals, std::uint32_t most_samples, Results results);

  gpu::Device& device_;
  gpu::Kernel transform_;
};

}  // namespace scene_analyzer::spectrum
