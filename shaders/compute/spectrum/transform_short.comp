// transform_short.comp — One workgroup per segment: magnitudes of a short signal's transform, summed directly.
//
// By Horner's rule in steps of four samples: X_k = sum over b of w^(4b) (x_4b + x_4b+1 w + x_4b+2 w^2 + x_4b+3 w^3), w = exp(-2 pi i k / size).
// The powers of w come from a table; a thread has several frequencies, so that each sample is loaded once for all of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/spectrum.h"
layout(local_size_x = 32) in;
layout(push_constant, scalar) uniform Block { ShortParams params; };
layout(binding = 0, scalar) readonly buffer Signals { ShortSignal signals[]; };
layout(binding = 1, scalar) readonly buffer Roots { dvec2 roots[]; };
layout(binding = 2, scalar) readonly buffer Segments { Segment segments[]; };
layout(binding = 3, scalar) readonly buffer Samples { double samples[]; };
layout(binding = 4, scalar) writeonly buffer Parts { SpectrumPart parts[]; };
layout(binding = 5, scalar) writeonly buffer Magnitudes { double magnitudes[]; };
#include "compute/lib/threads.glsl"
#include "compute/spectrum/complex.glsl"
#include "compute/spectrum/totals.glsl"

void main() {
  uint index = global_group();
  bool wanted = index < params.segments;
  Segment segment = segments[wanted ? index : 0];
  ShortSignal signal = signals[segment.signal];
  uint end = wanted ? segment.first + segment.count : 0;
  uint first = segment.first + gl_LocalInvocationID.x;

  dvec2 w1[kShortFrequencies], w2[kShortFrequencies], w3[kShortFrequencies], w4[kShortFrequencies], x[kShortFrequencies];
  for (uint j = 0; j < kShortFrequencies; ++j) {
    uint k = first + j * kShortThreads < end ? first + j * kShortThreads : 0;
    w1[j] = roots[signal.first_root + k];
    w2[j] = roots[signal.first_root + 2 * k % signal.size];
    w3[j] = roots[signal.first_root + 3 * k % signal.size];
    w4[j] = roots[signal.first_root + 4 * k % signal.size];
    x[j] = dvec2(0);
  }
  uint last = signal.first_sample;
  uint n = signal.first_sample + (signal.size + kHornerStep - 1) / kHornerStep * kHornerStep;
  for (n = first < end ? n : last; n > last; n -= kHornerStep) {
    double x0 = samples[n - 4], x1 = samples[n - 3], x2 = samples[n - 2], x3 = samples[n - 1];
    for (uint j = 0; j < kShortFrequencies; ++j) {
      dvec2 four = w1[j] * x1 + w2[j] * x2 + w3[j] * x3;
      x[j] = times(x[j], w4[j]) + dvec2(four.x + x0, four.y);
    }
  }

  SpectrumPart own = no_part();
  for (uint j = 0; j < kShortFrequencies; ++j) {
    uint k = first + j * kShortThreads;
    double magnitude = magnitude_of(x[j]);
    if (k == 0) own.zero = x[j].x;
    if (k > 0 && k < end) add_magnitude(own, k, magnitude);
    for (bool writes = params.write_magnitudes != 0 && k < end; writes; writes = false)
      magnitudes[signal.first_magnitude + k] = magnitude;
  }
  write_part(index, own, wanted);
}
