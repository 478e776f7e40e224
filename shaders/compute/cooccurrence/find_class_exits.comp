// find_class_exits.comp — One thread per block of sorted areas: for each place, where the chain of classes that starts there leaves the block.
//
// A class takes all areas within kSameArea of its smallest one, and the next class starts at the first beyond: a chain that each mesh must follow from
// its smallest area. Exits shorten it to one step per block, so that one thread can walk it (walk_class_chain.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { SortedParams params; };
layout(binding = 0, scalar) readonly buffer Blocks { Chunk blocks[]; };
layout(binding = 1, scalar) readonly buffer Ranges { SortedRange ranges[]; };
layout(binding = 2, scalar) readonly buffer Sorted { double sorted[]; };
layout(binding = 3, scalar) buffer Exits { uint exits[]; };
layout(binding = 4, scalar) writeonly buffer Entries { uint entries[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/area_classes.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.blocks) return;
  entries[index] = kNone;
  Chunk block = blocks[index];
  uint block_end = block.first + block.count;
  uint next = ranges[block.mesh].first + ranges[block.mesh].count;
  for (uint place = block_end; place-- > block.first;) {
    double start = sorted[place];
    // Ends never move forward as starts move back: most often the end is the same or one before.
    bool shrinks = next - place > 1 && !same_class(start, sorted[next - 1]);
    next = shrinks ? class_end(start, place, next - 1) : next;
    exits[place] = next >= block_end ? next : exits[next];
  }
}
