// chirp.glsl — The chirp exp(-pi i k^2 / size), exactly: k^2 modulo 2 size in integers, then tables. Needs buffers signals, phases and complex.glsl.
#ifndef SCENE_ANALYZER_SPECTRUM_CHIRP
#define SCENE_ANALYZER_SPECTRUM_CHIRP

// k^2 mod 2 size, for k and size up to 2^24. k^2 is exact in a double. The quotient is never too high, since k^2 / 2 size is an integer or
// further from the next one than rounding reaches, and one too low at most, where it is an integer. So the remainder fits 32 bits, although square and
// product wrap around.
uint square_modulo_period(uint k, ChirpSignal signal) {
  uint period = 2 * signal.size;
  uint quotient = uint(double(k) * double(k) * signal.inverse_period);
  uint remainder = k * k - quotient * period;
  return remainder >= period ? remainder - period : remainder;
}

// exp(-pi i j / size), j in [0, 2 size).
dvec2 phase_at(uint j, ChirpSignal signal) {
  uint fine = j & ((1u << signal.fine_bits) - 1u);
  uint coarse = (1u << signal.fine_bits) + (j >> signal.fine_bits);
  return times(phases[signal.first_phase + coarse], phases[signal.first_phase + fine]);
}

dvec2 chirp_at(uint k, ChirpSignal signal) { return phase_at(square_modulo_period(k, signal), signal); }

#endif
