#version 460
layout(location = 0) in vec3 position;
layout(push_constant) uniform Params { vec4 color; } params;

void main() { gl_Position = vec4(position, 1); }
