#version 460
layout(location = 0) out vec4 color;
layout(push_constant) uniform Params { vec4 color; } params;

void main() { color = params.color; }
