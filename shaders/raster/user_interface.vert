#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/user_interface.h"
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 given_texture_position;
layout(location = 2) in vec4 given_color;
layout(push_constant, scalar) uniform Params { InterfaceDrawParams params; };
layout(location = 0) out vec2 texture_position;
layout(location = 1) out vec4 color;

void main() {
  texture_position = given_texture_position;
  color = given_color;
  gl_Position = vec4(position * vec2(params.scale[0], params.scale[1]) - 1, 0, 1);
}
