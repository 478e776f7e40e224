// radix.glsl — Transforms of kRadix numbers in registers, 1, 2, 3, 4, 6, 8, 12 or 16. Needs const uint kRadix, buffer twiddles and complex.glsl.
//
// As kFirst x kSecond, either 1 to 4: kSecond transforms of kFirst numbers, roots of unity, kFirst transforms of kSecond numbers. Loops have constant bounds and
// are unrolled by every compiler, so that the array is registers.
#ifndef SCENE_ANALYZER_SPECTRUM_RADIX
#define SCENE_ANALYZER_SPECTRUM_RADIX

const uint kFirst = kRadix % 3 == 0 ? 3 : (kRadix == 16 ? 4 : (kRadix == 8 ? 2 : 1));
const uint kSecond = kRadix / kFirst;

dvec2 v[kMostRadix];
dvec2 powers[kMostRadix];

// exp(-2 pi i m / 16) and exp(-2 pi i m / 12)
const dvec2 kRootsOf16[10] = dvec2[10](
    dvec2(1, 0), dvec2(0.92387953251128675613LF, -0.38268343236508977173LF),
    dvec2(0.70710678118654752440LF, -0.70710678118654752440LF), dvec2(0.38268343236508977173LF, -0.92387953251128675613LF),
    dvec2(0, -1), dvec2(-0.38268343236508977173LF, -0.92387953251128675613LF),
    dvec2(-0.70710678118654752440LF, -0.70710678118654752440LF), dvec2(-0.92387953251128675613LF, -0.38268343236508977173LF),
    dvec2(-1, 0), dvec2(-0.92387953251128675613LF, 0.38268343236508977173LF));
const dvec2 kRootsOf12[7] = dvec2[7](
    dvec2(1, 0), dvec2(0.86602540378443864676LF, -0.5LF), dvec2(0.5LF, -0.86602540378443864676LF), dvec2(0, -1),
    dvec2(-0.5LF, -0.86602540378443864676LF), dvec2(-0.86602540378443864676LF, -0.5LF), dvec2(-1, 0));

dvec2 root_of_radix(uint m) { return kFirst == 3 ? kRootsOf12[m * (12 / kRadix)] : kRootsOf16[m * (16 / kRadix)]; }

void transform_2(uint a, uint b) {
  dvec2 difference = v[a] - v[b];
  v[a] += v[b];
  v[b] = difference;
}

void transform_3(uint a, uint b, uint c) {
  dvec2 sum = v[b] + v[c], turned = times_minus_i(v[b] - v[c]) * 0.86602540378443864676LF;
  dvec2 middle = v[a] - 0.5LF * sum;
  v[a] += sum;
  v[b] = middle + turned;
  v[c] = middle - turned;
}

void transform_4(uint a, uint b, uint c, uint d) {
  dvec2 ac = v[a] + v[c], a_c = v[a] - v[c], bd = v[b] + v[d], b_d = times_minus_i(v[b] - v[d]);
  v[a] = ac + bd;
  v[b] = a_c + b_d;
  v[c] = ac - bd;
  v[d] = a_c - b_d;
}

// Result q goes to v[result_of(q)].
uint result_of(uint q) { return q % kFirst * kSecond + q / kFirst; }

void transform() {
  for (uint i = 0; i < kSecond; ++i) {
    if (kFirst == 2) transform_2(i, i + kSecond);
    if (kFirst == 3) transform_3(i, i + kSecond, i + 2 * kSecond);
    if (kFirst == 4) transform_4(i, i + kSecond, i + 2 * kSecond, i + 3 * kSecond);
  }
  for (uint q = 1; q < kFirst; ++q)
    for (uint i = 1; i < kSecond; ++i) v[q * kSecond + i] = times(v[q * kSecond + i], root_of_radix(q * i));
  for (uint q = 0; q < kFirst; ++q) {
    uint at = q * kSecond;
    if (kSecond == 2) transform_2(at, at + 1);
    if (kSecond == 4) transform_4(at, at + 1, at + 2, at + 3);
  }
}

// powers[q] = exp(-2 pi i index q / kTwiddles). Few products each, so that none is less exact than the tables by more than some last bits.
void raise_twiddle(uint index) {
  dvec2 fine = twiddles[index & ((1u << kTwiddleFineBits) - 1u)];
  powers[0] = dvec2(1, 0);
  powers[1] = times(fine, twiddles[(1u << kTwiddleFineBits) + (index >> kTwiddleFineBits)]);
  for (uint q = 2; q < kRadix; ++q) powers[q] = times(powers[q / 2], powers[(q + 1) / 2]);
}

#endif
