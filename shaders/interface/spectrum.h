// spectrum.h — Parameters of the spectrum room's kernels.
//
// Signals lie behind each other in one buffer of samples. A signal of even length counts as one of complex
// numbers, half as long: sample 2n is the real part of number n, sample 2n + 1 its imaginary part.
#ifndef SCENE_ANALYZER_INTERFACE_SPECTRUM_H
#define SCENE_ANALYZER_INTERFACE_SPECTRUM_H
#include "types.h"

INTERFACE_BEGIN(spectrum)

INTERFACE_CONST uint kShortThreads = 32;     // per workgroup
INTERFACE_CONST uint kShortFrequencies = 4;  // per thread
INTERFACE_CONST uint kHornerStep = 4;        // short signals are padded with zeros to multiples of this
INTERFACE_CONST uint kRowThreads = 64;       // per workgroup that looks at elements of rows
INTERFACE_CONST uint kRowElements = 256;     // that it looks at; rows are multiples of this
INTERFACE_CONST uint kTotalThreads = 64;     // per workgroup that adds up magnitudes
INTERFACE_CONST uint kTotalElements = 2048;  // that it looks at, at most
INTERFACE_CONST uint kMostRadix = 16;
INTERFACE_CONST uint kMostWindows = 4;  // buffers that one row lies in

// Twiddle factors exp(-2 pi i j / kTwiddles), each the product of an entry of the fine table, for the lower
// bits of j, and one of the coarse table behind it. Every length of a row divides kTwiddles.
INTERFACE_CONST uint kTwiddles = 100663296;  // 3 2^25
INTERFACE_CONST uint kTwiddleFineBits = 13;

// Summed up over the frequencies that one workgroup looked at.
struct SpectrumPart {
  double zero;  // X_0, with its sign
  double largest;
  double sum;
  double weighted_sum;
};

// A signal whose transform is summed directly.
struct ShortSignal {
  uint first_sample;
  uint size;        // samples
  uint first_root;  // of `size` roots of unity, exp(-2 pi i j / size)
  uint first_magnitude;
};

// A signal as a row of the chirp transform.
struct ChirpSignal {
  double inverse_period;  // 1 / 2 size
  uint first_sample;
  uint size;         // numbers, so half the samples of an even signal
  uint first_phase;  // 2^fine_bits fine and then the coarse entries of exp(-pi i j / size)
  uint fine_bits;
  uint chirp;  // the row that its chirp is in
  uint first_magnitude;
};

// What one workgroup looks at.
struct Segment {
  uint signal;
  uint first;  // frequency, or pair k, size - k
  uint count;
};

struct ShortParams {
  uint segments;
  uint write_magnitudes;  // 0: only totals
};

// A row has `radix` legs of 2^inner_bits elements. Number q + radix n of a signal lies in leg q; there, the
// numbers n are spread over parts in the same way, by a radix 2^b for each level: 4 bits b of
// `inner_radices`, those of the longest parts lowest, until they are 0. Within the shortest parts numbers lie
// in order.
struct RowShape {
  uint radix;
  uint inner_bits;
  uint inner_radices;
};

// Rows one behind the other, or a window of one row.
struct RowParams {
  uint groups;          // of kRowElements elements
  uint groups_per_row;  // or per window
  uint first_row;
  uint first;     // element of its row at which the window begins
  uint elements;  // of a row
  RowShape shape;
};

// Passes over blocks of 2^length_bits elements within legs.
struct PassParams {
  uint threads;
  uint length_bits;
  uint twiddle_step;  // kTwiddles / 2^length_bits
};

struct ConvolveParams {
  uint threads;
  uint inner_bits;
  uint twiddle_step;  // kTwiddles / length of a row
};

struct TotalParams {
  double inverse_length;  // of a row
  uint segments;
  uint write_magnitudes;
  uint window;  // elements per buffer
  RowShape shape;
};

INTERFACE_END
#endif
