#include "spectrum/row_convolution.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "convolve_rows.spv.h"
#include "gpu/error.h"
#include "pass_rows.spv.h"

namespace scene_analyzer::spectrum {

using namespace interface::spectrum;

namespace {

constexpr std::uint32_t kShortPlanBits = 8;  // of the plan for rows of up to 16 times its length
constexpr std::uint32_t kMostPassBits = 4;

static_assert(kRowElements == 1U << kShortPlanBits);  // so that rows are multiples of it

std::uint32_t log2_of(std::uint32_t power_of_two) {
  return static_cast<std::uint32_t>(std::bit_width(power_of_two) - 1);
}

ComplexArray make_twiddles(gpu::Device& device) {
  std::vector<Complex> table;
  append_split_roots(table, kTwiddles, kTwiddleFineBits);
  ComplexArray array(device, "twiddle factors", table.size());
  array.upload(device, table);
  return array;
}

// Radices of 4 to 16 that make up 2^bits, bits not 1.
std::vector<std::uint32_t> split_bits(std::uint32_t bits) {
  const std::uint32_t passes = (bits + kMostPassBits - 1) / kMostPassBits;
  std::vector<std::uint32_t> split;
  for (std::uint32_t i = 0; i < passes; ++i) split.push_back((bits + i) / passes);
  return split;
}

}  // namespace

RowShape RowForm::shape() const {
  RowShape shape{.radix = radix, .inner_bits = inner_bits, .inner_radices = 0};
  for (std::size_t i = 0; i < pass_bits.size(); ++i) shape.inner_radices |= pass_bits[i] << (4 * i);
  return shape;
}

RowConvolution::RowConvolution(gpu::Device& device, std::uint32_t window)
    : device_(device),
      window_(window),
      longest_plan_bits_(log2_of(longest_fft_row(device))),
      twiddles_(make_twiddles(device)) {}

// Lengths are 2^n and 3 2^n.
std::uint32_t RowConvolution::row_length(std::uint64_t elements) {
  const auto power =
      static_cast<std::uint32_t>(std::bit_ceil(std::max<std::uint64_t>(elements, kRowElements)));
  const std::uint32_t three_quarters = power / 4 * 3;
  return elements <= three_quarters && three_quarters > 2 * kRowElements ? three_quarters : power;
}

RowForm RowConvolution::form(std::uint32_t length) const {
  RowForm form;
  if (length <= kMostRadix << kShortPlanBits) {
    form = {.radix = length >> kShortPlanBits,
            .inner_bits = kShortPlanBits,
            .plan_bits = kShortPlanBits,
            .pass_bits = {}};
  } else {  // as many legs as leave each to a plan, or to a plan and passes
    form.radix = length % 3 == 0 ? 12 : 16;
    while (length / form.radix < 1U << longest_plan_bits_ || length / form.radix == 2U << longest_plan_bits_)
      form.radix /= 2;
    form.inner_bits = log2_of(length / form.radix);
    form.plan_bits = longest_plan_bits_;
    form.pass_bits = split_bits(form.inner_bits - form.plan_bits);
  }
  while (form.windows <= kMostWindows &&
         (form.elements_of_window() > window_ || form.radix % form.windows != 0))
    ++form.windows;
  if (form.windows > kMostWindows)
    throw gpu::OutOfMemory("a row of " + std::to_string(length) + " complex numbers is beyond " +
                           std::to_string(kMostWindows) + " buffers of " + std::to_string(window_));
  return form;
}

std::uint64_t RowConvolution::elements_for(std::uint64_t rows, const RowForm& form) {
  const std::uint64_t group = plan(form.plan_bits).rows_per_group();
  const std::uint64_t parts = rows * form.elements() >> form.plan_bits;
  return (parts + group - 1) / group * group << form.plan_bits;
}

FftPlan& RowConvolution::plan(std::uint32_t bits) {
  Plan& entry = plans_.at(bits);
  if (!entry.fft) entry.fft = std::make_unique<FftPlan>(device_, 1U << bits, window_ >> bits);
  return *entry.fft;
}

const gpu::Kernel& RowConvolution::pass(std::uint32_t radix_bits, bool back) {
  gpu::Kernel& kernel = passes_[{radix_bits, back}];
  if (!kernel) {
    const std::uint32_t constants[] = {1U << radix_bits, back ? 1U : 0U};
    const std::string name = std::string(back ? "split" : "join") + "_rows_" + std::to_string(constants[0]);
    kernel = device_.make_kernel(name, pass_rows_spv, constants);
  }
  return kernel;
}

const gpu::Kernel& RowConvolution::convolve(const RowForm& form) {
  gpu::Kernel& kernel = convolve_[{form.radix, form.windows}];
  if (!kernel) {
    const std::uint32_t constants[] = {form.radix, form.windows};
    kernel = device_.make_kernel("convolve_rows_" + std::to_string(form.radix), convolve_rows_spv, constants);
  }
  return kernel;
}

void RowConvolution::bind(const ComplexArray& array) {
  bound_ = &array;
  ++binding_;
}

void RowConvolution::record_plan(gpu::Recorder& recorder, std::uint32_t parts, std::uint32_t bits) {
  FftPlan& fft = plan(bits);
  if (std::exchange(plans_[bits].binding, binding_) != binding_) fft.bind(bound_->buffer());
  fft.record(recorder, parts);
}

void RowConvolution::record_pass(gpu::Recorder& recorder, std::uint64_t elements, std::uint32_t length_bits,
                                 std::uint32_t radix_bits, bool back) {
  const PassParams params{.threads = static_cast<std::uint32_t>(elements >> radix_bits),
                          .length_bits = length_bits,
                          .twiddle_step = kTwiddles >> length_bits};
  recorder.run(pass(radix_bits, back), params.threads, params, {twiddles_, *bound_});
}

// From the order of RowShape to natural order, leg by leg.
void RowConvolution::record_legs(gpu::Recorder& recorder, std::uint32_t legs, const RowForm& form) {
  record_plan(recorder, legs << (form.inner_bits - form.plan_bits), form.plan_bits);
  std::uint32_t length_bits = form.plan_bits;
  for (auto bits = form.pass_bits.rbegin(); bits != form.pass_bits.rend(); ++bits) {
    length_bits += *bits;
    record_pass(recorder, std::uint64_t{legs} << form.inner_bits, length_bits, *bits, false);
  }
}

void RowConvolution::record_legs_back(gpu::Recorder& recorder, std::uint32_t legs, const RowForm& form) {
  std::uint32_t length_bits = form.inner_bits;
  for (const std::uint32_t bits : form.pass_bits) {
    record_pass(recorder, std::uint64_t{legs} << form.inner_bits, length_bits, bits, true);
    length_bits -= bits;
  }
  record_plan(recorder, legs << (form.inner_bits - form.plan_bits), form.plan_bits);
}

void RowConvolution::record(gpu::Recorder& recorder, const RowForm& form,
                            const gpu::Array<ChirpSignal>& signals, const ComplexArray& rows,
                            std::uint32_t signal_rows, std::uint32_t chirp_rows) {
  bind(rows);
  record_legs(recorder, (signal_rows + chirp_rows) * form.radix, form);
  const ConvolveParams params{.threads = signal_rows << form.inner_bits,
                              .inner_bits = form.inner_bits,
                              .twiddle_step = kTwiddles / form.elements()};
  recorder.run(convolve(form), params.threads, params,
               {twiddles_, signals, rows, rows, rows, rows, rows, rows, rows, rows});
  record_legs_back(recorder, signal_rows * form.radix, form);
}

void RowConvolution::run(const RowForm& form, const gpu::Array<ChirpSignal>& signal,
                         std::span<const ComplexArray> row, std::span<const ComplexArray> chirp) {
  const std::uint32_t legs = form.radix / form.windows;
  gpu::Recorder recorder(device_);
  const auto run_legs = [&](std::span<const ComplexArray> windows, auto record_them) {
    for (const ComplexArray& window : windows) {  // one at a time: a plan can be bound to one of them
      bind(window);
      (this->*record_them)(recorder, legs, form);
      recorder.submit_and_wait();
    }
  };
  run_legs(chirp, &RowConvolution::record_legs);
  run_legs(row, &RowConvolution::record_legs);
  // Where there are fewer than kMostWindows, the last one stands in.
  const auto nth = [](std::span<const ComplexArray> windows, std::size_t n) -> const ComplexArray& {
    return windows[std::min(n, windows.size() - 1)];
  };
  const ConvolveParams params{.threads = 1U << form.inner_bits,
                              .inner_bits = form.inner_bits,
                              .twiddle_step = kTwiddles / form.elements()};
  recorder.run(convolve(form), params.threads, params,
               {twiddles_, signal, nth(row, 0), nth(row, 1), nth(row, 2), nth(row, 3), nth(chirp, 0),
                nth(chirp, 1), nth(chirp, 2), nth(chirp, 3)});
  recorder.submit_and_wait();
  run_legs(row, &RowConvolution::record_legs_back);
}

}  // namespace scene_analyzer::spectrum
