// scene_render.h — Parameters of the shaders that draw a scene.
#ifndef SCENE_ANALYZER_INTERFACE_SCENE_RENDER_H
#define SCENE_ANALYZER_INTERFACE_SCENE_RENDER_H
#include "types.h"

INTERFACE_BEGIN(scene_render)

// Bits of SceneDrawParams::flags.
INTERFACE_CONST uint kTextured = 1u;      // the mesh's own colour is multiplied by its texture
INTERFACE_CONST uint kMixLuminance = 2u;  // the mean of the colour and the own colour's luminance is shown
INTERFACE_CONST uint kOwnColor = 4u;      // the own colour is shown
INTERFACE_CONST uint kUnlit = 16u;        // the colour as it is
INTERFACE_CONST uint kHatched = 8u;       // with darker stripes: there is no value

// One mesh instance. Colours are packed, red in the lowest byte.
struct SceneDrawParams {
  INTERFACE_ARRAY(float, view_from_mesh, 12);  // row-major 3 x 4
  // Scale of x and of y, distance of the nearest plane, what is in the middle of the picture: x and y at
  // distance 1.
  INTERFACE_ARRAY(float, projection, 5);
  INTERFACE_ARRAY(float, texture_position, 4);  // scale of u and v, what is added
  uint color;                                   // alpha: opacity
  uint own_color;                               // of its material
  uint flags;
  uint first_value;  // triangle groups: of the mesh's first triangle, in bytes
};

INTERFACE_END
#endif
