// totals.glsl — Totals over a workgroup, in a fixed order. Include it after layout(local_size_x = ...). Needs buffer parts.
#ifndef SCENE_ANALYZER_SPECTRUM_TOTALS
#define SCENE_ANALYZER_SPECTRUM_TOTALS

shared SpectrumPart parts_of_threads[gl_WorkGroupSize.x];

SpectrumPart no_part() { return SpectrumPart(0.0LF, 0.0LF, 0.0LF, 0.0LF); }

// Frequency 0 is not part of them.
void add_magnitude(inout SpectrumPart part, uint frequency, double magnitude) {
  part.largest = max(part.largest, magnitude);
  part.sum += magnitude;
  part.weighted_sum += double(frequency) * magnitude;
}

// To be called by all threads of the workgroup. Frequency 0 is thread 0's.
void write_part(uint segment, SpectrumPart own, bool wanted) {
  parts_of_threads[gl_LocalInvocationID.x] = own;
  barrier();
  for (bool writes = wanted && gl_LocalInvocationID.x == 0; writes; writes = false) {
    for (uint thread = 1; thread < gl_WorkGroupSize.x; ++thread) {
      own.largest = max(own.largest, parts_of_threads[thread].largest);
      own.sum += parts_of_threads[thread].sum;
      own.weighted_sum += parts_of_threads[thread].weighted_sum;
    }
    parts[segment] = own;
  }
}

#endif
