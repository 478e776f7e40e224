// surface_distances.h — Parameters of the surface_distances room's kernel.
#ifndef SCENE_ANALYZER_INTERFACE_SURFACE_DISTANCES_H
#define SCENE_ANALYZER_INTERFACE_SURFACE_DISTANCES_H
#include "types.h"

INTERFACE_BEGIN(surface_distances)

struct ArcParams {
  uint first;  // triangles [first, first + count) of the batch
  uint count;
};

INTERFACE_END
#endif
