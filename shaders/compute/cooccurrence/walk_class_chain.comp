// walk_class_chain.comp — One thread per mesh: the first class start within each block that the chain visits.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Ranges { SortedRange ranges[]; };
layout(binding = 1, scalar) readonly buffer Exits { uint exits[]; };
layout(binding = 2, scalar) writeonly buffer Entries { uint entries[]; };
#include "compute/lib/threads.glsl"

void main() {
  uint mesh = global_thread();
  if (mesh >= params.meshes) return;
  SortedRange range = ranges[mesh];
  for (uint place = range.first; place < range.first + range.count; place = exits[place])
    entries[range.first_block + (place - range.first) / kClassBlock] = place;
}
