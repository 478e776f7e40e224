// float_bits.glsl — float32 numbers as their bits.
#ifndef SCENE_ANALYZER_LIB_FLOAT_BITS
#define SCENE_ANALYZER_LIB_FLOAT_BITS

bool is_finite_bits(uint bits) { return (bits & 0x7F800000u) != 0x7F800000u; }

// An integer of the same order, so that least and largest coordinates are exact on devices that flush subnormal
// numbers, too.
uint ordered_bits(uint bits) { return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u; }

#endif
