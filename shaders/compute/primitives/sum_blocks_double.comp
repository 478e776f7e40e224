// sum_blocks_double.comp — sum_blocks.glsl for double.
#version 460
#extension GL_GOOGLE_include_directive : require
#define VALUE double
#include "compute/primitives/sum_blocks.glsl"
