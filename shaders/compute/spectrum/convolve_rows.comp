// convolve_rows.comp — One thread per kRadix elements a leg apart: joins the legs' transforms, of signal and chirp, into the rows', multiplies these, and takes the
// product apart again into legs for the way back. See pass_rows.comp; this is its last pass forward, the product, and its first pass back.
//
// The product is conjugated, so that forward transforms of the legs do what inverse ones would, but for another conjugation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kRadix = 4;
layout(constant_id = 1) const uint kWindows = 1;  // buffers that a row lies in; with more than 1 there is one row
layout(push_constant, scalar) uniform Block { ConvolveParams params; };
layout(binding = 0, scalar) readonly buffer Twiddles { dvec2 twiddles[]; };
layout(binding = 1, scalar) readonly buffer Signals { ChirpSignal signals[]; };
layout(binding = 2, scalar) buffer Rows0 { dvec2 rows_0[]; };
layout(binding = 3, scalar) buffer Rows1 { dvec2 rows_1[]; };
layout(binding = 4, scalar) buffer Rows2 { dvec2 rows_2[]; };
layout(binding = 5, scalar) buffer Rows3 { dvec2 rows_3[]; };
layout(binding = 6, scalar) readonly buffer Chirps0 { dvec2 chirps_0[]; };
layout(binding = 7, scalar) readonly buffer Chirps1 { dvec2 chirps_1[]; };
layout(binding = 8, scalar) readonly buffer Chirps2 { dvec2 chirps_2[]; };
layout(binding = 9, scalar) readonly buffer Chirps3 { dvec2 chirps_3[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/radix.glsl"

const uint kLegs = kRadix / kWindows;  // per buffer

dvec2 chirp_spectrum[kMostRadix];

void load_chirp(uint at, uint leg) {
  for (uint q = 0; q < kLegs; ++q) {
    v[q] = chirps_0[at + q * leg];
    if (kWindows > 1) v[kLegs + q] = chirps_1[at + q * leg];
    if (kWindows > 2) v[2 * kLegs + q] = chirps_2[at + q * leg];
    if (kWindows > 3) v[3 * kLegs + q] = chirps_3[at + q * leg];
  }
}

void load_row(uint at, uint leg) {
  for (uint q = 0; q < kLegs; ++q) {
    v[q] = rows_0[at + q * leg];
    if (kWindows > 1) v[kLegs + q] = rows_1[at + q * leg];
    if (kWindows > 2) v[2 * kLegs + q] = rows_2[at + q * leg];
    if (kWindows > 3) v[3 * kLegs + q] = rows_3[at + q * leg];
  }
}

void store_row(uint at, uint leg) {
  for (uint q = 0; q < kLegs; ++q) {
    rows_0[at + q * leg] = times(v[result_of(q)], powers[q]);
    if (kWindows > 1) rows_1[at + q * leg] = times(v[result_of(kLegs + q)], powers[kLegs + q]);
    if (kWindows > 2) rows_2[at + q * leg] = times(v[result_of(2 * kLegs + q)], powers[2 * kLegs + q]);
    if (kWindows > 3) rows_3[at + q * leg] = times(v[result_of(3 * kLegs + q)], powers[3 * kLegs + q]);
  }
}

void join_legs() {
  for (uint q = 1; q < kRadix; ++q) v[q] = times(v[q], powers[q]);
  transform();
}

void main() {
  uint index = global_thread();
  if (index >= params.threads) return;
  uint leg = 1u << params.inner_bits;
  uint row = index >> params.inner_bits;
  uint place = index & (leg - 1u);
  raise_twiddle(place * params.twiddle_step);
  load_chirp((signals[row].chirp << params.inner_bits) * kRadix + place, leg);
  join_legs();
  for (uint q = 0; q < kRadix; ++q) chirp_spectrum[q] = v[q];
  load_row((row << params.inner_bits) * kRadix + place, leg);
  join_legs();
  for (uint q = 0; q < kRadix; ++q) chirp_spectrum[q] = conjugate(times(v[q], chirp_spectrum[q]));
  for (uint q = 0; q < kRadix; ++q) v[q] = chirp_spectrum[result_of(q)];
  transform();
  store_row((row << params.inner_bits) * kRadix + place, leg);
}
