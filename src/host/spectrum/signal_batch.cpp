#include "spectrum/signal_batch.h"

#include <algorithm>
#include <cmath>

namespace scene_analyzer::spectrum {

using namespace interface::spectrum;

namespace {

// Powers of two that are numbers, as are their inverses. Values of up to 2^24, or down to 2^-74, are left
// over then.
constexpr int kMostExponent = 1000;

int exponent_of(std::span<const double> samples) {
  double largest = 0;
  for (const double sample : samples) largest = std::max(largest, std::abs(sample));
  int exponent = 0;
  if (std::isfinite(largest)) std::frexp(largest, &exponent);
  return std::clamp(exponent, -kMostExponent, kMostExponent);
}

}  // namespace

std::uint32_t SignalBatch::add_samples(const Signal& signal, std::uint32_t padding) {
  const std::span<const double> samples = signal.samples;
  const int exponent = exponent_of(samples);
  const double scale = std::ldexp(1.0, -exponent);
  double sum = 0;
  for (const double sample : samples) sum += sample * scale;
  const double mean = sum / static_cast<double>(samples.size());

  const std::size_t first = samples_.size();
  samples_.resize(first + (samples.size() + padding - 1) / padding * padding);
  for (std::size_t i = 0; i < samples.size(); ++i) samples_[first + i] = samples[i] * scale - mean;
  entries_.push_back({.index = signal.index, .size = samples.size(), .exponent = exponent, .mean = mean});
  return static_cast<std::uint32_t>(first);
}

std::uint32_t SignalBatch::add_magnitudes(const Signal& signal) {
  const std::uint64_t first = magnitude_count_;
  if (wants_magnitudes()) magnitude_count_ += signal.samples.size() / 2 + 1;
  entries_.back().first_magnitude = static_cast<std::uint32_t>(first);
  return static_cast<std::uint32_t>(first);
}

void SignalBatch::add_segments(std::uint32_t count, std::uint32_t most) {
  const auto signal = static_cast<std::uint32_t>(entries_.size() - 1);
  for (std::uint32_t first = 0; first < count; first += most)
    segments_.push_back({.signal = signal, .first = first, .count = std::min(most, count - first)});
}

gpu::Array<double> SignalBatch::upload_samples(gpu::Device& device) const {
  gpu::Array<double> array(device, "samples of signals", samples_.size());
  array.upload(device, samples_);
  return array;
}

gpu::Array<Segment> SignalBatch::upload_segments(gpu::Device& device) const {
  gpu::Array<Segment> array(device, "segments of spectra", segments_.size());
  array.upload(device, segments_);
  return array;
}

gpu::Array<SpectrumPart> SignalBatch::make_parts(gpu::Device& device) const {
  return {device, "parts of spectra", segments_.size()};
}

gpu::Array<double> SignalBatch::make_magnitudes(gpu::Device& device) const {
  return {device, "magnitudes of spectra", magnitude_count_};
}

void SignalBatch::finish(gpu::Device& device, const gpu::Array<SpectrumPart>& parts,
                         const gpu::Array<double>& magnitudes) const {
  std::vector<SpectrumPart> totals(entries_.size());
  const std::vector<SpectrumPart> found = parts.download(device);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    SpectrumPart& total = totals[segments_[i].signal];
    total.zero += found[i].zero;
    total.largest = std::max(total.largest, found[i].largest);
    total.sum += found[i].sum;
    total.weighted_sum += found[i].weighted_sum;
  }
  std::vector<double> values;
  if (wants_magnitudes()) values = magnitudes.download(device);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    const auto scaled = [&](double value) { return std::ldexp(value, entry.exponent); };
    const double zero = std::abs(totals[i].zero + entry.mean * static_cast<double>(entry.size));
    results_.totals[entry.index] = {.zero = scaled(zero),
                                    .largest = scaled(totals[i].largest),
                                    .sum = scaled(totals[i].sum),
                                    .weighted_sum = scaled(totals[i].weighted_sum)};
    if (!wants_magnitudes()) continue;
    const std::span<double> own = std::span(values).subspan(entry.first_magnitude, entry.size / 2 + 1);
    own.front() = zero;
    for (double& value : own) value = scaled(value);
    results_.sink(entry.index, own);
  }
}

}  // namespace scene_analyzer::spectrum
