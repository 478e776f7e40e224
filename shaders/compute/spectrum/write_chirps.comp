// write_chirps.comp — One workgroup per kRowElements elements of chirp rows: the conjugate chirp by lag, lags below zero at the row's end.
//
// Lags run from 1 - size to the highest frequency that is asked for; with even lengths that is size - 1, with odd ones half of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kEven = 0;
layout(push_constant, scalar) uniform Block { RowParams params; };
layout(binding = 0, scalar) readonly buffer Signals { ChirpSignal signals[]; };  // one per chirp
layout(binding = 1, scalar) readonly buffer Phases { dvec2 phases[]; };
layout(binding = 2, scalar) writeonly buffer Rows { dvec2 rows[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/chirp.glsl"
#include "compute/spectrum/row_order.glsl"

void main() {
  uint group = global_group();
  if (group >= params.groups) return;
  uint row = group / params.groups_per_row;
  ChirpSignal signal = signals[row];
  uint highest = kEven == 0 ? signal.size / 2 : signal.size - 1;
  uint first = params.first + (group - row * params.groups_per_row) * kRowElements;
  for (uint i = gl_LocalInvocationID.x; i < kRowElements; i += kRowThreads) {
    uint n = number_at(first + i, params.shape);
    uint lag = n <= highest ? n : params.elements - n;
    dvec2 value = dvec2(0);
    for (bool inside = lag < signal.size; inside; inside = false) value = conjugate(chirp_at(lag, signal));
    rows[params.first_row * params.elements + group * kRowElements + i] = value;
  }
}
