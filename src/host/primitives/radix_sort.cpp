#include "primitives/radix_sort.h"

#include <cstdint>
#include <string>
#include <utility>

#include "count_digits.spv.h"
#include "interface/primitives.h"
#include "scatter_digits.spv.h"

namespace scene_analyzer::primitives {

using namespace interface::primitives;

KeyedValues make_keyed_values(gpu::Device& device, const char* name, std::uint64_t count) {
  const std::string prefix = name;
  return {gpu::Array<std::uint32_t>(device, prefix + " (low words)", count),
          gpu::Array<std::uint32_t>(device, prefix + " (high words)", count),
          gpu::Array<std::uint32_t>(device, prefix + " (values)", count)};
}

RadixSort::RadixSort(gpu::Device& device, const Scan& scan)
    : scan_(scan),
      count_digits_(device.make_kernel("count_digits", count_digits_spv)),
      scatter_digits_(device.make_kernel("scatter_digits", scatter_digits_spv)) {}

KeyedValues RadixSort::record(gpu::Recorder& recorder, KeyedValues input, std::uint64_t count,
                              std::uint32_t key_bits) const {
  gpu::Device& device = recorder.device();
  KeyedValues output = make_keyed_values(device, "sort scratch", count);
  const std::uint64_t tiles = (count + kTileKeys - 1) / kTileKeys;
  const auto& offsets = recorder.keep(gpu::Array<std::uint32_t>(device, "digit offsets", tiles * kDigits));
  for (std::uint32_t shift = 0; shift < key_bits; shift += kDigitBits) {
    const SortParams params{.count = static_cast<std::uint32_t>(count),
                            .shift = shift,
                            .tiles = static_cast<std::uint32_t>(tiles)};
    const auto& digit_words = shift < 32 ? input.low : input.high;
    recorder.run_groups(count_digits_, tiles, params, {digit_words, offsets});
    scan_.record(recorder, offsets, tiles * kDigits);
    recorder.run_groups(
        scatter_digits_, tiles, params,
        {offsets, input.low, input.high, input.values, output.low, output.high, output.values, digit_words});
    std::swap(input, output);
  }
  recorder.keep(std::move(output.low));
  recorder.keep(std::move(output.high));
  recorder.keep(std::move(output.values));
  return input;
}

}  // namespace scene_analyzer::primitives
