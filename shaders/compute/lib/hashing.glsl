// hashing.glsl — Integer hashing for open-addressed tables.
#ifndef SCENE_ANALYZER_LIB_HASHING
#define SCENE_ANALYZER_LIB_HASHING

// A bijective 32-bit mixer: two rounds of multiply and xor-shift with odd constants (golden ratio and sqrt(3)).
uint scramble(uint h) {
  h ^= h >> 16;
  h *= 0x9E3779B1u;
  h ^= h >> 15;
  h *= 0xBB67AE85u;
  h ^= h >> 16;
  return h;
}

// hash / 2^32 * size: a slot in [0, size) for tables of any size.
uint scale_to(uint hash, uint size) {
  uint high, low;
  umulExtended(hash, size, high, low);
  return high;
}

#endif
