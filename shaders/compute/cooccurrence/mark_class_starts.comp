// mark_class_starts.comp — One thread per block: 1 at places where a class starts, 0 elsewhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Blocks { Chunk blocks[]; };
layout(binding = 1, scalar) readonly buffer Sorted { double sorted[]; };
layout(binding = 2, scalar) readonly buffer Entries { uint entries[]; };
layout(binding = 3, scalar) writeonly buffer Starts { uint starts[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/area_classes.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.blocks) return;
  Chunk block = blocks[index];
  uint entry = entries[index];
  double start = 0.0LF;
  bool inside = false;
  for (uint place = block.first; place < block.first + block.count; ++place) {
    double area = sorted[place];
    bool starts_here = place == entry || (inside && !same_class(start, area));
    start = starts_here ? area : start;
    inside = inside || starts_here;
    starts[place] = starts_here ? 1 : 0;
  }
}
