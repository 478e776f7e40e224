#include "spectrum/chirp_batch.h"

#include <bit>
#include <span>

#include "spectrum/roots.h"

namespace scene_analyzer::spectrum {

using namespace interface::spectrum;

namespace {

template <typename T>
gpu::Array<T> uploaded(gpu::Device& device, const char* name, const std::vector<T>& values) {
  gpu::Array<T> array(device, name, values.size());
  array.upload(device, values);
  return array;
}

}  // namespace

std::uint32_t size_of(const Signal& signal) {
  const std::uint64_t samples = signal.samples.size();
  return static_cast<std::uint32_t>(is_even(signal) ? samples / 2 : samples);
}

std::uint64_t lags_of(const Signal& signal) {
  const std::uint64_t size = size_of(signal);
  return is_even(signal) ? 2 * size - 1 : size + size / 2;
}

std::size_t ChirpBatch::rows_with(const Signal& signal) const {
  const bool known = !chirps_.empty() && chirps_.back().size == size_of(signal);
  return signals_.size() + 1 + chirps_.size() + (known ? 0 : 1);
}

void ChirpBatch::add_chirp(std::uint32_t size) {
  const std::uint32_t period = 2 * size;
  const auto fine_bits = static_cast<std::uint32_t>(std::bit_width(period) / 2);
  chirps_.push_back({.inverse_period = 1.0 / period,
                     .first_sample = 0,
                     .size = size,
                     .first_phase = static_cast<std::uint32_t>(phases_.size()),
                     .fine_bits = fine_bits,
                     .chirp = static_cast<std::uint32_t>(chirps_.size()),
                     .first_magnitude = 0});
  append_split_roots(phases_, period, fine_bits);
}

void ChirpBatch::add(const Signal& signal) {
  const std::uint32_t size = size_of(signal);
  if (chirps_.empty() || chirps_.back().size != size) add_chirp(size);
  ChirpSignal record = chirps_.back();
  record.first_sample = batch_.add_samples(signal, 1);
  record.first_magnitude = batch_.add_magnitudes(signal);
  batch_.add_segments(size / 2 + 1, kTotalElements);
  signals_.push_back(record);
}

ChirpBatch::OnDevice ChirpBatch::upload(gpu::Device& device, std::uint32_t first_chirp) const {
  std::vector<ChirpSignal> signals = signals_;
  for (ChirpSignal& signal : signals) signal.chirp += first_chirp;
  return {.samples = batch_.upload_samples(device),
          .magnitudes = batch_.make_magnitudes(device),
          .signals = uploaded(device, "signals", signals),
          .chirps = uploaded(device, "chirps", chirps_),
          .phases = uploaded(device, "phases of chirps", phases_),
          .segments = batch_.upload_segments(device),
          .parts = batch_.make_parts(device)};
}

}  // namespace scene_analyzer::spectrum
