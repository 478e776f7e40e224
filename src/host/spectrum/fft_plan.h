// fft_plan.h — Discrete Fourier transforms of rows in a buffer: VkFFT, behind a face without Vulkan.
//
// Made for powers of two that one workgroup holds in its shared memory, in double precision and the forward
// direction only; what is longer, of another length or backwards is built around these (row_transform.h,
// chirp_transform.h). Making a plan means generating GLSL and compiling it: some 100 ms, or 6 ms when the
// SPIR-V lies in the device's cache folder, and the driver's own compilation at the first use.
#pragma once

#include <cstdint>
#include <memory>

#include "gpu/device.h"
#include "gpu/recorder.h"

namespace scene_analyzer::spectrum {

// The longest row: the largest power of two whose complex numbers fit into shared memory, at most 2^11.
std::uint32_t longest_fft_row(const gpu::Device& device);

class FftPlan {
 public:
  // Rows of `length` complex doubles (re, im), a power of two in [2, longest_fft_row()], `capacity` of them
  // one behind the other. Throws gpu::Error, OutOfMemory, DeviceLost. Memory: tables of 20 bytes per element
  // of one row.
  FftPlan(gpu::Device& device, std::uint32_t length, std::uint32_t capacity);
  ~FftPlan();
  FftPlan(const FftPlan&) = delete;
  FftPlan& operator=(const FftPlan&) = delete;

  // Rows are transformed in groups of this many; the buffer must hold the last group whole.
  std::uint32_t rows_per_group() const;

  // What later recordings transform. No recording that uses the plan may wait to be submitted.
  void bind(const gpu::Buffer& buffer);

  // The first `rows` rows of the bound buffer become their transforms (unscaled, exponent -2 pi i), in place
  // and in natural order. `rows` in [1, capacity].
  void record(gpu::Recorder& recorder, std::uint32_t rows);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::spectrum
