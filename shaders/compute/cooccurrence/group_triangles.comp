// group_triangles.comp — One thread per triangle: the number of its attribute among the distinct ones of the batch. Classes that were merged share one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { LabelParams params; };
layout(binding = 0, scalar) readonly buffer ClassOf { uint class_of[]; };
layout(binding = 1, scalar) readonly buffer GroupOf { uint group_of[]; };
layout(binding = 2, scalar) writeonly buffer Labels { uint labels[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint t = global_thread();
  if (t < params.triangles) labels[t] = group_of[class_of[t]];
}
