#version 460
layout(location = 0) in vec2 texture_position;
layout(location = 1) in vec4 color;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 shown;

// Text is as large as its texture: a smaller version would only be less sharp.
void main() { shown = color * textureLod(image, texture_position, 0); }
