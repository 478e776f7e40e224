// chirp_transform.h — Spectra of longer signals of any length: the chirp transform (Bluestein 1970) around
// transforms of powers of two.
//
// With k n = (k^2 + n^2 - (k - n)^2) / 2 a transform is a convolution with a chirp, exp(pi i k^2 / size)
// (row_convolution.h). Phases come from k^2 modulo 2 size, in integers. A signal of even length N counts as N
// / 2 complex numbers, and its row is as long as all lags between two of them; with odd N only half of the
// frequencies are wanted, and the row has room for the lags to these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "spectrum/chirp_batch.h"
#include "spectrum/row_convolution.h"
#include "spectrum/signal_batch.h"

namespace scene_analyzer::spectrum {

class ChirpTransform {
 public:
  // `window` and `batch` as in SpectrumLimits.
  ChirpTransform(gpu::Device& device, std::uint32_t window, std::uint32_t batch);

  // Signals of more than one sample. Runs to completion. Signals whose rows are of one length, and both even
  // or both odd, go in batches; signals of equal length share a chirp. Each takes a row, and each chirp.
  void run(std::span<const Signal> signals, Results results);

 private:
  struct Item {
    Signal signal;
    std::uint32_t row_length = 0;
  };

  std::uint32_t batch_rows(std::uint32_t row_length) const;
  std::uint64_t workspace_elements(std::span<const Item> items);
  std::size_t run_batch(std::span<const Item> items, const ComplexArray& workspace, Results results);
  void run_long(const Signal& signal, const RowForm& form, Results results);
  const gpu::Kernel& modulate(bool even);
  const gpu::Kernel& write_chirps(bool even);
  const gpu::Kernel& total(bool even, std::uint32_t windows);
  void record_totals(gpu::Recorder& recorder, const ChirpBatch& batch, const ChirpBatch::OnDevice& arrays,
                     const RowForm& form, bool even, std::span<const ComplexArray> rows);

  gpu::Device& device_;
  std::uint32_t window_;
  std::uint32_t batch_;
  RowConvolution convolution_;
  // Made when first needed: by evenness, and windows of a row.
  std::map<bool, gpu::Kernel> modulate_, write_chirps_;
  std::map<std::pair<bool, std::uint32_t>, gpu::Kernel> total_;
};

}  // namespace scene_analyzer::spectrum
