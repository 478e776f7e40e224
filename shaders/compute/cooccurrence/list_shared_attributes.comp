// list_shared_attributes.comp — One thread per shared half-edge: its triangle's attribute and its square, to be scanned; the differences of the
// scans give the sums over any edge without visiting pairs.
//
// Attributes are rounded to kAttributeSteps, and squares are kept in two parts: all sums are then exact, so that they are the same whatever other
// meshes stand before this one in the scan.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedValueParams params; };
layout(binding = 0, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 1, scalar) readonly buffer ClassOf { uint class_of[]; };
layout(binding = 2, scalar) readonly buffer ClassValues { double class_values[]; };
layout(binding = 3, scalar) readonly buffer ClassRanges { ClassRange class_ranges[]; };
layout(binding = 4, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 5, scalar) writeonly buffer Sums { double sums[]; };
layout(binding = 6, scalar) writeonly buffer Squares { double squares[]; };  // in whole steps
layout(binding = 7, scalar) writeonly buffer Rests { double rests[]; };      // what the squares have beyond
#include "compute/lib/threads.glsl"
#include "compute/lib/attributes.glsl"

void main() {
  uint place = global_thread();
  if (place > params.count) return;
  double value = 0.0LF;
  if (place < params.count) {
    uint triangle = half_edges[place] / 3;
    ClassRange range = class_ranges[mesh_of[triangle]];
    value = in_steps(attribute_of(triangle, range, inverse_span(range)));
  }
  double square = value * value;
  double whole = floor(square * kAttributeSteps) / kAttributeSteps;
  sums[place] = value;
  squares[place] = whole;
  rests[place] = square - whole;
}
