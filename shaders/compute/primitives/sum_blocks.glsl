// sum_blocks.glsl — One thread per block of kScanBlock elements: their sum, in order. VALUE is defined by the including kernel.
#include "interface/primitives.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ScanParams params; };
layout(binding = 0, scalar) readonly buffer Values { VALUE values[]; };
layout(binding = 1, scalar) writeonly buffer Sums { VALUE sums[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint first = global_thread() * kScanBlock;
  if (first >= params.count) return;
  uint last = min(first + kScanBlock, params.count);
  VALUE sum = VALUE(0);
  for (uint i = first; i < last; ++i) sum += values[i];
  sums[global_thread()] = sum;
}
