#include "primitives/scan.h"

#include <cstdint>

#include "interface/primitives.h"
#include "scan_blocks_double.spv.h"
#include "scan_blocks_uint.spv.h"
#include "sum_blocks_double.spv.h"
#include "sum_blocks_uint.spv.h"

namespace scene_analyzer::primitives {
namespace {

using interface::primitives::kScanBlock;
using interface::primitives::ScanParams;

template <typename T>
void record_level(gpu::Recorder& recorder, const gpu::Kernel& sum, const gpu::Kernel& scan,
                  const gpu::Array<T>& values, std::uint64_t count) {
  const std::uint64_t blocks = (count + kScanBlock - 1) / kScanBlock;
  const ScanParams params{.count = static_cast<std::uint32_t>(count)};
  const auto& offsets = recorder.keep(gpu::Array<T>(recorder.device(), "block offsets", blocks));
  if (blocks <= 1) {
    recorder.fill(offsets, 0);
  } else {
    recorder.run(sum, blocks, params, {values, offsets});
    record_level(recorder, sum, scan, offsets, blocks);
  }
  recorder.run(scan, blocks, params, {values, offsets});
}

}  // namespace

Scan::Scan(gpu::Device& device)
    : sum_uint_(device.make_kernel("sum_blocks_uint", sum_blocks_uint_spv)),
      scan_uint_(device.make_kernel("scan_blocks_uint", scan_blocks_uint_spv)),
      sum_double_(device.make_kernel("sum_blocks_double", sum_blocks_double_spv)),
      scan_double_(device.make_kernel("scan_blocks_double", scan_blocks_double_spv)) {}

void Scan::record(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& values,
                  std::uint64_t count) const {
  record_level(recorder, sum_uint_, scan_uint_, values, count);
}

void Scan::record(gpu::Recorder& recorder, const gpu::Array<double>& values, std::uint64_t count) const {
  record_level(recorder, sum_double_, scan_double_, values, count);
}

}  // namespace scene_analyzer::primitives
