// scan.h — Exclusive prefix sums on the device, in place and in a fixed order: the same input gives the same
// bits.
//
// Each thread scans kScanBlock elements in order; sums of blocks are scanned the same way. Cost: linear, 2
// dispatches per level. Memory: count / 127 elements of scratch.
#pragma once

#include <cstdint>

#include "gpu/device.h"
#include "gpu/recorder.h"

namespace scene_analyzer::primitives {

class Scan {
 public:
  explicit Scan(gpu::Device& device);

  // values[i] becomes the sum of the former values[0..i). Unsigned sums wrap.
  void record(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& values, std::uint64_t count) const;
  void record(gpu::Recorder& recorder, const gpu::Array<double>& values, std::uint64_t count) const;

 private:
  gpu::Kernel sum_uint_, scan_uint_, sum_double_, scan_double_;
};

}  // namespace scene_analyzer::primitives
