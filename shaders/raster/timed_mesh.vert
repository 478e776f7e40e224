#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/render_timing.h"
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 view_position;
layout(push_constant, scalar) uniform Params { TimedDrawParams params; };

// Parallel projection: every rotation shows the mesh at one size.
void main() {
  for (uint row = 0; row < 3; ++row)
    view_position[row] = dot(vec3(params.rotation[3 * row], params.rotation[3 * row + 1], params.rotation[3 * row + 2]), position);
  gl_Position = vec4(view_position.x * params.aspect[0], view_position.y * params.aspect[1], 0.5 + 0.5 * view_position.z, 1);
}
