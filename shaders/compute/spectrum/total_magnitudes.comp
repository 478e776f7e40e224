// total_magnitudes.comp — One workgroup per segment: magnitudes of a signal's transform out of its convolution with the chirp.
//
// Odd length: |X_k| is the convolution's. Even: with Z, the transform of the numbers (chirp times convolution), E = (Z_k + conj Z_{h-k}) / 2 and
// O = (Z_k - conj Z_{h-k}) / 2i, h half the length, give X_k = E + w O and |X_{h-k}| = |E - w O|, w = exp(-pi i k / h): pairs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kEven = 0;
layout(constant_id = 1) const uint kWindows = 1;
layout(push_constant, scalar) uniform Block { TotalParams params; };
layout(binding = 0, scalar) readonly buffer Signals { ChirpSignal signals[]; };
layout(binding = 1, scalar) readonly buffer Phases { dvec2 phases[]; };
layout(binding = 2, scalar) readonly buffer Segments { Segment segments[]; };
layout(binding = 3, scalar) readonly buffer Rows0 { dvec2 rows_0[]; };
layout(binding = 4, scalar) readonly buffer Rows1 { dvec2 rows_1[]; };
layout(binding = 5, scalar) readonly buffer Rows2 { dvec2 rows_2[]; };
layout(binding = 6, scalar) readonly buffer Rows3 { dvec2 rows_3[]; };
layout(binding = 7, scalar) writeonly buffer Parts { SpectrumPart parts[]; };
layout(binding = 8, scalar) writeonly buffer Magnitudes { double magnitudes[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/chirp.glsl"
#include "compute/spectrum/row_order.glsl"
#include "compute/spectrum/totals.glsl"

SpectrumPart own = no_part();

// The convolution, scaled; what lies in the row is conjugated.
dvec2 convolution_at(uint row_begin, uint k) {
  uint place = row_begin + place_of_number(k, params.shape);
  dvec2 value;
  if (kWindows < 2 || place < params.window) value = rows_0[place];
  else if (kWindows < 3 || place < 2 * params.window) value = rows_1[place - params.window];
  else if (kWindows < 4 || place < 3 * params.window) value = rows_2[place - 2 * params.window];
  else value = rows_3[place - 3 * params.window];
  return conjugate(value) * params.inverse_length;
}

void add(ChirpSignal signal, uint frequency, double magnitude) {
  if (frequency > 0) add_magnitude(own, frequency, magnitude);
  for (bool writes = params.write_magnitudes != 0; writes; writes = false)
    magnitudes[signal.first_magnitude + frequency] = magnitude;
}

void add_odd(ChirpSignal signal, uint row_begin, uint k) {
  dvec2 x = convolution_at(row_begin, k);
  if (k == 0) own.zero = x.x;
  add(signal, k, magnitude_of(x));
}

void add_pair(ChirpSignal signal, uint row_begin, uint k) {
  uint other = k == 0 ? 0 : signal.size - k;
  dvec2 z = times(convolution_at(row_begin, k), chirp_at(k, signal));
  dvec2 z_other = conjugate(times(convolution_at(row_begin, other), chirp_at(other, signal)));
  dvec2 even = (z + z_other) * 0.5LF;
  dvec2 odd = times(times_minus_i(z - z_other) * 0.5LF, phase_at(k, signal));
  dvec2 x = even + odd;
  if (k == 0) own.zero = x.x;
  add(signal, k, magnitude_of(x));
  if (2 * k != signal.size) add(signal, signal.size - k, magnitude_of(even - odd));
}

void main() {
  uint index = global_group();
  bool wanted = index < params.segments;
  Segment segment = segments[wanted ? index : 0];
  ChirpSignal signal = signals[segment.signal];
  uint row_begin = (segment.signal << params.shape.inner_bits) * params.shape.radix;
  uint end = wanted ? segment.first + segment.count : 0;
  for (uint k = segment.first + gl_LocalInvocationID.x; k < end; k += kTotalThreads) {
    if (kEven == 0) add_odd(signal, row_begin, k); else add_pair(signal, row_begin, k);
  }
  write_part(index, own, wanted);
}
