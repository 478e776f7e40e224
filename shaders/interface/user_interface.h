// user_interface.h — Parameters of the shaders that draw panels.
#ifndef SCENE_ANALYZER_INTERFACE_USER_INTERFACE_H
#define SCENE_ANALYZER_INTERFACE_USER_INTERFACE_H
#include "types.h"

INTERFACE_BEGIN(user_interface)

struct InterfaceDrawParams {
  INTERFACE_ARRAY(float, scale, 2);  // 2 / size of the display, whose origin is its upper left corner
};

INTERFACE_END
#endif
