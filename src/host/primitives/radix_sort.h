// radix_sort.h — Stable sort of 64-bit keys with 32-bit values on the device.
//
// Least significant digit first, 8 bits a pass; each pass counts digits per tile, scans the counts and
// scatters. No assumption about the subgroup size, no atomics: the same input gives the same output. Cost:
// linear per pass. Memory: 12 bytes per key of scratch, and 0.25 for counts.
#pragma once

#include <cstdint>

#include "gpu/device.h"
#include "gpu/recorder.h"
#include "primitives/scan.h"

namespace scene_analyzer::primitives {

// A key is high[i] * 2^32 + low[i].
struct KeyedValues {
  gpu::Array<std::uint32_t> low, high, values;
};
KeyedValues make_keyed_values(gpu::Device& device, const char* name, std::uint64_t count);

class RadixSort {
 public:
  RadixSort(gpu::Device& device, const Scan& scan);

  // Sorts by bits [0, key_bits) of the keys, key_bits in [1, 64]; the other bits must be equal in all keys or
  // do not matter. `input` is used as scratch; the sorted arrays are returned.
  KeyedValues record(gpu::Recorder& recorder, KeyedValues input, std::uint64_t count,
                     std::uint32_t key_bits) const;

 private:
  const Scan& scan_;
  gpu::Kernel count_digits_, scatter_digits_;
};

}  // namespace scene_analyzer::primitives
