#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scene_render.h"
#include "raster/lib/shading.glsl"
layout(location = 0) in vec3 view_position;
layout(location = 1) in vec3 view_normal;
layout(location = 2) in vec2 texture_position;
layout(location = 3) in vec3 shape_position;
layout(push_constant, scalar) uniform Params { SceneDrawParams params; };
layout(set = 0, binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 shown;

vec3 own_color() {
  vec3 own = unpackUnorm4x8(params.own_color).rgb;
  return (params.flags & kTextured) != 0 ? own * texture(image, texture_position).rgb : own;
}

void main() {
  vec4 color = unpackUnorm4x8(params.color);
  if ((params.flags & kOwnColor) != 0) color.rgb = own_color();
  if ((params.flags & kMixLuminance) != 0)
    color.rgb = (color.rgb + dot(own_color(), vec3(0.299, 0.587, 0.114))) / 2;
  if ((params.flags & kHatched) != 0 && fract((gl_FragCoord.x + gl_FragCoord.y) / 8) < 0.5) color.rgb *= 0.8;
  if ((params.flags & kUnlit) != 0) {
    shown = color;
    return;
  }
  shown = vec4(color.rgb * shade(shaded_normal(shape_position, view_position, view_normal)), color.a);
}
