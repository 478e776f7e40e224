#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scene_render.h"
layout(location = 0) in vec3 position;
layout(location = 1) in uint packed_normal;
layout(location = 2) in vec2 packed_texture_position;
layout(push_constant, scalar) uniform Params { SceneDrawParams params; };
layout(location = 0) out vec3 view_position;
layout(location = 1) out vec3 view_normal;
layout(location = 2) out vec2 texture_position;
layout(location = 3) out vec3 shape_position;

// Three numbers of 10 bits, 512 is 0.
vec3 unpack_normal(uint word) {
  return (vec3(uvec3(word, word >> 10, word >> 20) & 1023u) - 512) / 511;
}

// Normals follow the matrix of cofactors, whatever the mesh is stretched to; their length stays as it is.
vec3 turn_normal(mat3 linear, vec3 normal) {
  vec3 turned = normal.x * cross(linear[1], linear[2]) + normal.y * cross(linear[2], linear[0]) +
                normal.z * cross(linear[0], linear[1]);
  float size = length(turned);
  return size > 0 ? turned * (length(normal) / size) : vec3(0);
}

void main() {
  mat3 linear;
  vec3 moved;
  for (uint row = 0; row < 3; ++row) {
    for (uint column = 0; column < 3; ++column) linear[column][row] = params.view_from_mesh[4 * row + column];
    moved[row] = params.view_from_mesh[4 * row + 3];
  }
  shape_position = linear * position;
  view_position = shape_position + moved;
  view_normal = turn_normal(linear, unpack_normal(packed_normal));
  texture_position = packed_texture_position * vec2(params.texture_position[0], params.texture_position[1]) +
                     vec2(params.texture_position[2], params.texture_position[3]);
  // Depth is near / distance: 1 at the nearest plane, 0 infinitely far away.
  vec2 from_middle = view_position.xy + view_position.z * vec2(params.projection[3], params.projection[4]);
  gl_Position = vec4(from_middle.x * params.projection[0], -from_middle.y * params.projection[1],
                     params.projection[2], -view_position.z);
}
