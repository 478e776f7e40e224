// positions.glsl — Analysed positions: local float32 coordinates, in double, under the mesh's linear part.
//
// Needs buffers position_x, position_y, position_z (uint bits) and meshes (MeshRecord).
#ifndef SCENE_ANALYZER_LIB_POSITIONS
#define SCENE_ANALYZER_LIB_POSITIONS
#include "compute/lib/float_bits.glsl"

// Batches hold either similarities only, measured in local coordinates, or transformed geometries only.
layout(constant_id = 0) const uint kTransformed = 0;

// Exact also for subnormal numbers, which devices may flush to zero in a float conversion.
double exact_double(uint bits) {
  if ((bits & 0x7F800000u) == 0u) {
    double magnitude = double(bits & 0x007FFFFFu) * 1.401298464324817e-45LF;
    return (bits & 0x80000000u) != 0u ? -magnitude : magnitude;
  }
  return double(uintBitsToFloat(bits));
}

dvec3 local_position(uint vertex) {
  return dvec3(exact_double(position_x[vertex]), exact_double(position_y[vertex]),
               exact_double(position_z[vertex]));
}

dvec3 transform(dvec3 p, uint mesh) {
  if (kTransformed == 0) return p;
  precise dvec3 q;
  for (uint row = 0; row < 3; ++row) {
    q[row] = meshes[mesh].linear[3 * row] * p.x + meshes[mesh].linear[3 * row + 1] * p.y +
             meshes[mesh].linear[3 * row + 2] * p.z;
  }
  return q;
}

dvec3 analysed_position(uint vertex, uint mesh) { return transform(local_position(vertex), mesh); }

bool is_finite(uint vertex) {
  return is_finite_bits(position_x[vertex]) && is_finite_bits(position_y[vertex]) &&
         is_finite_bits(position_z[vertex]);
}

#endif
