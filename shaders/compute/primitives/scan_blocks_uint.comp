// scan_blocks_uint.comp — scan_blocks.glsl for uint.
#version 460
#extension GL_GOOGLE_include_directive : require
#define VALUE uint
#include "compute/primitives/scan_blocks.glsl"
