#include "spectrum/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/error.h"
#include "spectrum/chirp_transform.h"
#include "spectrum/roots.h"
#include "spectrum/short_transform.h"

namespace scene_analyzer::spectrum {
namespace {

constexpr std::uint32_t kMostShortSamples = 1U << 12;
constexpr std::uint32_t kLeastWindow = 1U << 12;

SpectrumLimits checked(SpectrumLimits limits, const gpu::DeviceInfo& info) {
  if (limits.short_samples < 1 || limits.short_samples > kMostShortSamples)
    throw std::logic_error("SpectrumLimits::short_samples is outside [1, 2^12]");
  if (limits.window < kLeastWindow || !std::has_single_bit(limits.window))
    throw std::logic_error("SpectrumLimits::window is no power of two from 2^12");
  if (limits.longest > kLongestSignal)
    throw std::logic_error("SpectrumLimits::longest is beyond kLongestSignal");
  if (limits.batch < 1) throw std::logic_error("SpectrumLimits::batch is 0");
  const std::uint64_t bindable = info.max_storage_buffer_bytes / sizeof(Complex);
  limits.window =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(limits.window, std::bit_floor(bindable)));
  return limits;
}

void check_length(std::uint64_t samples, std::uint64_t longest) {
  if (samples <= longest) return;
  throw gpu::OutOfMemory("a signal has " + std::to_string(samples) +
                         " samples, but Fourier transforms are made of at most " + std::to_string(longest));
}

void finish_single(const Signal& signal, Results results) {
  const double magnitude = std::abs(signal.samples.front());
  results.totals[signal.index].zero = magnitude;
  if (results.sink) results.sink(signal.index, {&magnitude, 1});
}

}  // namespace

SpectrumBuilder::SpectrumBuilder(gpu::Device& device, SpectrumLimits limits)
    : device_(device), limits_(checked(limits, device.info())) {}
SpectrumBuilder::~SpectrumBuilder() = default;

std::vector<SpectrumTotals> SpectrumBuilder::transform(std::span<const std::span<const double>> signals,
                                                       const MagnitudeSink& magnitudes) {
  std::vector<SpectrumTotals> totals(signals.size());
  const Results results{totals, magnitudes};
  std::vector<Signal> small, large;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const Signal signal{.index = i, .samples = signals[i]};
    check_length(signal.samples.size(), limits_.longest);
    if (signal.samples.size() == 1)
      finish_single(signal, results);
    else if (!signal.samples.empty())
      (signal.samples.size() <= limits_.short_samples ? small : large).push_back(signal);
  }
  if (!small.empty()) {
    if (!short_) short_ = std::make_unique<ShortTransform>(device_);
    short_->run(std::move(small), limits_.batch, results);
  }
  if (!large.empty()) {
    if (!chirp_) chirp_ = std::make_unique<ChirpTransform>(device_, limits_.window, limits_.batch);
    chirp_->run(large, results);
  }
  return totals;
}

}  // namespace scene_analyzer::spectrum
