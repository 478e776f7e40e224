// range_classes.comp — One thread per mesh: its classes, their lowest and highest value.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Ranges { SortedRange ranges[]; };
layout(binding = 1, scalar) readonly buffer Starts { uint starts[]; };
layout(binding = 2, scalar) readonly buffer ClassValues { double class_values[]; };
layout(binding = 3, scalar) writeonly buffer ClassRanges { ClassRange class_ranges[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint mesh = global_thread();
  if (mesh >= params.meshes) return;
  uint first = starts[ranges[mesh].first];
  uint count = starts[ranges[mesh].first + ranges[mesh].count] - first;
  bool empty = count == 0;
  class_ranges[mesh] = ClassRange(empty ? 0.0LF : class_values[first], empty ? 0.0LF : class_values[first + count - 1], first, count);
}
