// sum_blocks_uint.comp — sum_blocks.glsl for uint.
#version 460
#extension GL_GOOGLE_include_directive : require
#define VALUE uint
#include "compute/primitives/sum_blocks.glsl"
