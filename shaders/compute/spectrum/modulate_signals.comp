// modulate_signals.comp — One workgroup per kRowElements elements of signal rows: the number of the signal times the chirp, zero behind its end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kEven = 0;
layout(push_constant, scalar) uniform Block { RowParams params; };
layout(binding = 0, scalar) readonly buffer Signals { ChirpSignal signals[]; };
layout(binding = 1, scalar) readonly buffer Phases { dvec2 phases[]; };
layout(binding = 2, scalar) readonly buffer Samples { double samples[]; };
layout(binding = 3, scalar) writeonly buffer Rows { dvec2 rows[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/chirp.glsl"
#include "compute/spectrum/row_order.glsl"

dvec2 modulated(ChirpSignal signal, uint n) {
  dvec2 chirp = chirp_at(n, signal);
  if (kEven == 0) return samples[signal.first_sample + n] * chirp;
  uint at = signal.first_sample + 2 * n;
  return times(dvec2(samples[at], samples[at + 1]), chirp);
}

void main() {
  uint group = global_group();
  if (group >= params.groups) return;
  uint row = group / params.groups_per_row;
  ChirpSignal signal = signals[row];
  uint first = params.first + (group - row * params.groups_per_row) * kRowElements;
  for (uint i = gl_LocalInvocationID.x; i < kRowElements; i += kRowThreads) {
    uint n = number_at(first + i, params.shape);
    dvec2 value = dvec2(0);
    // A loop that runs once or not at all: software devices leave it where no thread is inside.
    for (bool inside = n < signal.size; inside; inside = false) value = modulated(signal, n);
    rows[group * kRowElements + i] = value;
  }
}
