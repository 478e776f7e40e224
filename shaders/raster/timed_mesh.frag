#version 460
layout(location = 0) in vec3 view_position;
layout(location = 0) out vec4 color;

// Flat shading by a light at the eye. Alpha says that the pixel is covered.
void main() {
  vec3 normal = normalize(cross(dFdx(view_position), dFdy(view_position)));
  color = vec4(vec3(0.2 + 0.8 * abs(normal.z)), 1);
}
