// index_shared.comp — One thread per listed half-edge: where its edge begins and ends in the sorted list; twin points to the begin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SharedParams params; };
layout(binding = 0, scalar) readonly buffer Edges { uint edges[]; };   // sorted
layout(binding = 1, scalar) readonly buffer HalfEdges { uint half_edges[]; };
layout(binding = 2, scalar) writeonly buffer Begins { uint begins[]; };
layout(binding = 3, scalar) writeonly buffer Ends { uint ends[]; };
layout(binding = 4, scalar) writeonly buffer Twin { uint twin[]; };
#include "compute/lib/threads.glsl"

// First place whose edge is not below (strict: is above) the given one.
uint search(uint edge, bool strict) {
  uint low = 0, high = params.count;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (edges[middle] < edge || (strict && edges[middle] == edge)) low = middle + 1; else high = middle;
  }
  return low;
}

void main() {
  uint place = global_thread();
  if (place >= params.count) return;
  uint begin = search(edges[place], false);
  begins[place] = begin;
  ends[place] = search(edges[place], true);
  twin[half_edges[place]] = kShared | begin;
}
