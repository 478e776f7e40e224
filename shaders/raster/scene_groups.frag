#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scene_render.h"
#include "raster/lib/shading.glsl"
layout(location = 0) in vec3 view_position;
layout(location = 3) in vec3 shape_position;
layout(push_constant, scalar) uniform Params { SceneDrawParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Values { uint values[]; };   // a byte per triangle
layout(set = 0, binding = 2, scalar) readonly buffer Colors { uint colors[256]; };
layout(location = 0) out vec4 shown;

// Every triangle in the colour of its planar group's size. Triangles stand out, so each is shaded flat.
void main() {
  uint place = params.first_value + gl_PrimitiveID;
  uint value = values[place / 4] >> (8 * (place % 4)) & 255u;
  shown = vec4(unpackUnorm4x8(colors[value]).rgb * shade(flat_normal(shape_position, view_position)), unpackUnorm4x8(params.color).a);
}
