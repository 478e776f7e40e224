// planar_groups.h — Parameters of the planar groups room's kernels.
#ifndef SCENE_ANALYZER_INTERFACE_PLANAR_GROUPS_H
#define SCENE_ANALYZER_INTERFACE_PLANAR_GROUPS_H
#include "mesh.h"

INTERFACE_BEGIN(planar_groups)

struct NormalParams {
  uint triangles;
};

// The angle alpha up to which neighbours belong together, as sine and cosine: shaders have no double
// trigonometry.
struct JoinParams {
  double alpha;  // radians, [0, pi]
  double sin_alpha;
  double cos_alpha;
  uint count;       // triangles, or shared half-edges
  uint angle_bits;  // shared edges only: a turn about the edge has 2^angle_bits steps
};

struct SizeParams {
  uint chunk_count;
};

// What one chunk, and in the end one mesh, adds up to. Group sizes are counted at the group's lowest
// triangle.
struct PlanarTotals {
  double squared_sizes;  // of groups with more than one triangle; exact below 2^53
  uint groups;
  uint largest;  // triangles of the largest group
};

INTERFACE_END
#endif
