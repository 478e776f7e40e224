// sum_contrast.comp — One thread per chunk: sum over triangles of the mean squared difference between its attribute and its neighbours'.
//
// Attributes are carried to [0,1], so that the sum divided by the number of triangles with a neighbour is the rating.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/cooccurrence.h"
#include "interface/adjacency.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Block { ContrastParams params; };
layout(binding = 0, scalar) readonly buffer Chunks { Chunk chunks[]; };
layout(binding = 1, scalar) readonly buffer Twin { uint twin[]; };
layout(binding = 2, scalar) readonly buffer ClassOf { uint class_of[]; };
layout(binding = 3, scalar) readonly buffer ClassValues { double class_values[]; };
layout(binding = 4, scalar) readonly buffer ClassRanges { ClassRange class_ranges[]; };
layout(binding = 5, scalar) readonly buffer Ends { uint ends[]; };         // of shared edges
layout(binding = 6, scalar) readonly buffer Sums { double sums[]; };       // scanned, see list_shared_attributes.comp
layout(binding = 7, scalar) readonly buffer Squares { double squares[]; };
layout(binding = 8, scalar) readonly buffer Rests { double rests[]; };
layout(binding = 9, scalar) writeonly buffer Totals { double totals[]; };
#include "compute/lib/threads.glsl"
#include "compute/lib/attributes.glsl"

void main() {
  uint index = global_thread();
  if (index >= params.chunk_count) return;
  Chunk chunk = chunks[index];
  ClassRange range = class_ranges[chunk.mesh];
  double scale = inverse_span(range);
  double total = 0.0LF;
  for (uint t = chunk.first; t < chunk.first + chunk.count; ++t) {
    double own = attribute_of(t, range, scale);
    double sum = 0.0LF;
    uint neighbours = 0;
    for (uint h = 3 * t; h < 3 * t + 3; ++h) {
      uint other = twin[h];
      bool manifold = (other & kShared) == 0;
      double difference = own - attribute_of(manifold ? other / 3 : t, range, scale);
      sum += difference * difference;
      neighbours += manifold ? 1 : 0;
      // A loop that runs once or not at all: software devices execute both sides of a branch, but leave a loop that no
      // thread needs.
      for (bool among_many = !manifold && other != kNone; among_many; among_many = false) {
        uint begin = other & ~kShared;
        uint end = ends[begin];
        uint members = end - begin;
        double first = sums[end] - sums[begin];
        double second = (squares[end] - squares[begin]) + (rests[end] - rests[begin]);
        double value = in_steps(own);
        sum += max(0.0LF, double(members) * value * value - 2.0LF * value * first + second);
        neighbours += members - 1;
      }
    }
    total += neighbours > 0 ? sum / double(neighbours) : 0.0LF;
  }
  totals[index] = total;
}
