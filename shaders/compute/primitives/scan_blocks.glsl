// scan_blocks.glsl — One thread per block of kScanBlock elements: exclusive prefix sums in place, starting from the block's offset.
// VALUE is defined by the including kernel.
#include "interface/primitives.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ScanParams params; };
layout(binding = 0, scalar) buffer Values { VALUE values[]; };
layout(binding = 1, scalar) readonly buffer Offsets { VALUE offsets[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint first = global_thread() * kScanBlock;
  if (first >= params.count) return;
  uint last = min(first + kScanBlock, params.count);
  VALUE running = offsets[global_thread()];
  for (uint i = first; i < last; ++i) {
    VALUE value = values[i];
    values[i] = running;
    running += value;
  }
}
