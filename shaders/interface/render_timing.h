// render_timing.h — Parameters of the shaders that draw one mesh alone, and count the pixels it covers.
#ifndef SCENE_ANALYZER_INTERFACE_RENDER_TIMING_H
#define SCENE_ANALYZER_INTERFACE_RENDER_TIMING_H
#include "types.h"

INTERFACE_BEGIN(render_timing)

// Positions lie in the unit sphere; they are rotated into the view, in which the sphere touches the nearer
// two borders.
struct TimedDrawParams {
  INTERFACE_ARRAY(float, rotation, 9);  // row-major
  INTERFACE_ARRAY(float, aspect, 2);    // what a unit is in the view, at most 1
};

struct CountCoveredParams {
  uint pixels;
  uint counter;  // index of the count that is raised
};

INTERFACE_END
#endif
