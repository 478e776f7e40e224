// row_convolution.h — Circular convolutions of rows of complex doubles, as products of their Fourier
// transforms.
//
// A row of r 2^b elements has r legs, r one of 1, 2, 3, 4, 6, 8, 12 and 16. Legs are transformed by a plan
// (fft_plan.h), with passes of radix 4, 8 or 16 around it where they are longer than what a plan takes. One
// kernel then joins the legs of a row and of its chirp's row, multiplies, and takes the product apart again.
// So two lengths of plans are enough, rows are hardly longer than needed, and nothing is transposed: elements
// lie in the order of interface::spectrum::RowShape from the start.
//
// Cost for legs of up to 2^11 elements, rows of up to 32768: three reads and writes of all elements. Memory
// besides the rows: 320 KiB of twiddle factors, and the plans' tables.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/spectrum.h"
#include "spectrum/fft_plan.h"
#include "spectrum/roots.h"

namespace scene_analyzer::spectrum {

using ComplexArray = gpu::Array<Complex>;

// How a row is transformed, and where it lies.
struct RowForm {
  std::uint32_t radix = 1;
  std::uint32_t inner_bits = 0;          // of a leg
  std::uint32_t plan_bits = 0;           // of what is left to the plan
  std::vector<std::uint32_t> pass_bits;  // radices of the passes within legs, longest parts first
  std::uint32_t windows = 1;             // arrays that one row takes, all legs whole

  std::uint32_t elements() const { return radix << inner_bits; }
  std::uint32_t elements_of_window() const { return elements() / windows; }
  interface::spectrum::RowShape shape() const;
};

class RowConvolution {
 public:
  // Arrays hold at most `window` elements, a power of two and at least 2^12.
  RowConvolution(gpu::Device& device, std::uint32_t window);

  // The elements of the shortest row of at least `elements`, which are at most 2^25.
  static std::uint32_t row_length(std::uint64_t elements);
  // Of a row of a length that row_length() gave. Throws gpu::OutOfMemory when it takes more than kMostWindows
  // arrays.
  RowForm form(std::uint32_t length) const;

  // How many elements an array for `rows` whole rows must have: plans work on whole groups of parts.
  std::uint64_t elements_for(std::uint64_t rows, const RowForm& form);

  // The first `signal_rows` rows of the array, each of one window, become their convolutions with the row
  // that their ChirpSignal names among the `chirp_rows` rows behind them; conjugated and times elements(). No
  // recording that was made by this object before may still wait to be submitted.
  void record(gpu::Recorder& recorder, const RowForm& form,
              const gpu::Array<interface::spectrum::ChirpSignal>& signals, const ComplexArray& rows,
              std::uint32_t signal_rows, std::uint32_t chirp_rows);

  // The same for one row and one chirp, each in arrays of their own, as many as the form has windows. Runs to
  // completion.
  void run(const RowForm& form, const gpu::Array<interface::spectrum::ChirpSignal>& signal,
           std::span<const ComplexArray> row, std::span<const ComplexArray> chirp);

 private:
  struct Plan {
    std::unique_ptr<FftPlan> fft;
    std::uint64_t binding = 0;  // the last call of bind() that it knows of
  };

  FftPlan& plan(std::uint32_t bits);
  const gpu::Kernel& pass(std::uint32_t radix_bits, bool back);
  const gpu::Kernel& convolve(const RowForm& form);
  void bind(const ComplexArray& array);
  void record_plan(gpu::Recorder& recorder, std::uint32_t parts, std::uint32_t bits);
  void record_pass(gpu::Recorder& recorder, std::uint64_t elements, std::uint32_t length_bits,
                   std::uint32_t radix_bits, bool back);
  void record_legs(gpu::Recorder& recorder, std::uint32_t legs, const RowForm& form);
  void record_legs_back(gpu::Recorder& recorder, std::uint32_t legs, const RowForm& form);

  gpu::Device& device_;
  std::uint32_t window_;
  std::uint32_t longest_plan_bits_;
  const ComplexArray* bound_ = nullptr;
  std::uint64_t binding_ = 0;
  ComplexArray twiddles_;
  // Made when first needed.
  std::array<Plan, 16> plans_;                                               // by bits
  std::map<std::pair<std::uint32_t, bool>, gpu::Kernel> passes_;             // by radix bits and direction
  std::map<std::pair<std::uint32_t, std::uint32_t>, gpu::Kernel> convolve_;  // by radix and windows
};

}  // namespace scene_analyzer::spectrum
