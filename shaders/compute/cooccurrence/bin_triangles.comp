// bin_triangles.comp — One thread per triangle: the bin of its attribute between the mesh's lowest and highest; 0 in uniform meshes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { LabelParams params; };
layout(binding = 0, scalar) readonly buffer MeshOf { uint mesh_of[]; };
layout(binding = 1, scalar) readonly buffer ClassOf { uint class_of[]; };
layout(binding = 2, scalar) readonly buffer ClassValues { double class_values[]; };
layout(binding = 3, scalar) readonly buffer ClassRanges { ClassRange class_ranges[]; };
layout(binding = 4, scalar) writeonly buffer Labels { uint labels[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/attributes.glsl"

void main() {
  uint t = global_thread();
  if (t >= params.triangles) return;
  ClassRange range = class_ranges[mesh_of[t]];
  bool uniform_mesh = inverse_span(range) == 0.0LF;
  double span = uniform_mesh ? 1.0LF : range.highest - range.lowest;
  // Divided, not multiplied by the inverse: values on the border of two bins then fall as they do on the host.
  double place = double(kBins) * (class_values[class_of[t]] - range.lowest) / span;
  // Degenerate triangles may have the class of another mesh: any bin will do, they have no neighbours.
  labels[t] = uniform_mesh ? 0 : uint(clamp(place, 0.0LF, double(kBins - 1)));
}
