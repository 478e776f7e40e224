#version 460
#extension GL_EXT_scalar_block_layout : require
layout(push_constant) uniform Params { vec4 coordinates; };
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1, scalar) readonly buffer Values { float values[]; };
layout(location = 0) out vec4 color;

// The texture where the parameters say, its red replaced by a value of the triangle.
void main() {
  color = textureLod(image, coordinates.xy, coordinates.z);
  color.r = values[gl_PrimitiveID];
}
