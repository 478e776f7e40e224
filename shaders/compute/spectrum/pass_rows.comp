// pass_rows.comp — One thread per kRadix elements a part of a leg apart: one pass of a long transform around shorter ones.
//
// With L = r S, and number r n + q of a block at place q S + n, transforms of the r parts, y_q, make up that of the block: X[j S + i] = sum over q of
// w_r^(j q) w_L^(i q) y_q[i] (decimation in time). Backwards, out of natural order into that of parts, y_q[i] = w_L^(i q) sum over j of w_r^(j q) x[j S + i] comes
// first, and transforms of y_q follow (decimation in frequency). Both ways the exponent is -2 pi i.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kRadix = 4;
layout(constant_id = 1) const uint kBack = 0;
layout(push_constant, scalar) uniform Block { PassParams params; };
layout(binding = 0, scalar) readonly buffer Twiddles { dvec2 twiddles[]; };
layout(binding = 1, scalar) buffer Rows { dvec2 rows[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/radix.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.threads) return;
  uint part = (1u << params.length_bits) / kRadix;
  uint place = index & (part - 1u);
  uint at = (index - place) * kRadix + place;
  for (uint q = 0; q < kRadix; ++q) v[q] = rows[at + q * part];
  raise_twiddle(place * params.twiddle_step);
  if (kBack == 0)
    for (uint q = 1; q < kRadix; ++q) v[q] = times(v[q], powers[q]);
  transform();
  for (uint q = 0; q < kRadix; ++q) {
    dvec2 result = v[result_of(q)];
    rows[at + q * part] = kBack == 0 ? result : times(result, powers[q]);
  }
}
