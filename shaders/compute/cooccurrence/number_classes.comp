// number_classes.comp — One thread per sorted place: the class of the triangle there, and the value of a class where it starts.
//
// starts is exclusively scanned: the number of classes that started before each place; one more element holds the total.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Order { uint order[]; };
layout(binding = 1, scalar) readonly buffer Sorted { double sorted[]; };
layout(binding = 2, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 3, scalar) writeonly buffer ClassOf { uint class_of[]; };
layout(binding = 4, scalar) writeonly buffer ClassValues { double class_values[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint place = global_thread();
  if (place >= params.triangles) return;
  if (place >= params.count) {
    class_of[order[place]] = 0;  // degenerate: never looked at, but never out of range either
    return;
  }
  uint started = starts[place + 1];
  class_of[order[place]] = started - 1;
  if (started != starts[place]) class_values[started - 1] = sorted[place];
}
