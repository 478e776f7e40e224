#include "spectrum/short_transform.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "gpu/recorder.h"
#include "interface/spectrum.h"
#include "spectrum/roots.h"
#include "transform_short.spv.h"

namespace scene_analyzer::spectrum {

using namespace interface::spectrum;

ShortTransform::ShortTransform(gpu::Device& device)
    : device_(device), transform_(device.make_kernel("transform_short", transform_short_spv)) {}

void ShortTransform::run(std::vector<Signal> signals, std::uint32_t batch, Results results) {
  std::ranges::sort(signals, {},
                    [](const Signal& signal) { return std::pair(signal.samples.size(), signal.index); });
  for (std::size_t first = 0; first < signals.size();)
    first += run_batch(std::span(signals).subspan(first), batch, results);
}

// The first signals, until they have enough samples; returns how many.
std::size_t ShortTransform::run_batch(std::span<const Signal> signals, std::uint32_t most_samples,
                                      Results results) {
  SignalBatch batch(results);
  std::vector<ShortSignal> records;
  std::vector<Complex> roots;
  std::uint32_t first_root = 0;
  for (const Signal& signal : signals) {
    if (batch.sample_count() >= most_samples) break;
    const auto size = static_cast<std::uint32_t>(signal.samples.size());
    if (records.empty() || records.back().size != size) {
      first_root = static_cast<std::uint32_t>(roots.size());
      append_roots(roots, size);
    }
    const std::uint32_t first_sample = batch.add_samples(signal, kHornerStep);
    batch.add_segments(size / 2 + 1, kShortThreads * kShortFrequencies);
    records.push_back({.first_sample = first_sample,
                       .size = size,
                       .first_root = first_root,
                       .first_magnitude = batch.add_magnitudes(signal)});
  }

  const auto samples = batch.upload_samples(device_);
  const auto segments = batch.upload_segments(device_);
  const gpu::Array<ShortSignal> signals_on_device(device_, "short signals", records.size());
  signals_on_device.upload(device_, records);
  const gpu::Array<Complex> roots_on_device(device_, "roots of unity", roots.size());
  roots_on_device.upload(device_, roots);
  const auto parts = batch.make_parts(device_);
  const auto magnitudes = batch.make_magnitudes(device_);
  gpu::Recorder recorder(device_);
  const ShortParams params{.segments = static_cast<std::uint32_t>(segments.count()),
                           .write_magnitudes = batch.wants_magnitudes() ? 1U : 0U};
  recorder.run_groups(transform_, params.segments, params,
                      {signals_on_device, roots_on_device, segments, samples, parts, magnitudes});
  recorder.submit_and_wait();
  batch.finish(device_, parts, magnitudes);
  return records.size();
}

}  // namespace scene_analyzer::spectrum
