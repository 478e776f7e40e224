// number_members.comp — One thread: two elements of every struct that buffers hold, each member with a number of its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/mesh.h"
#include "interface/geometry.h"
#include "interface/adjacency.h"
#include "interface/defects.h"
#include "interface/planar_groups.h"
#include "interface/cooccurrence.h"
#include "interface/spectrum.h"
layout(local_size_x = 1) in;
layout(binding = 0, scalar) writeonly buffer A { MeshRecord mesh_records[2]; };
layout(binding = 1, scalar) writeonly buffer B { Chunk chunks[2]; };
layout(binding = 2, scalar) writeonly buffer C { GeometryTotals geometry_totals[2]; };
layout(binding = 3, scalar) writeonly buffer D { InstanceRecord instances[2]; };
layout(binding = 4, scalar) writeonly buffer E { TopologyTotals topology_totals[2]; };
layout(binding = 5, scalar) writeonly buffer F { PlanarTotals planar_totals[2]; };
layout(binding = 6, scalar) writeonly buffer G { SortedRange sorted_ranges[2]; };
layout(binding = 7, scalar) writeonly buffer H { ClassRange class_ranges[2]; };
layout(binding = 8, scalar) writeonly buffer I { SpectrumPart spectrum_parts[2]; };
layout(binding = 9, scalar) writeonly buffer J { ShortSignal short_signals[2]; };
layout(binding = 10, scalar) writeonly buffer K { ChirpSignal chirp_signals[2]; };
layout(binding = 11, scalar) writeonly buffer L { Segment segments[2]; };
layout(binding = 12, scalar) writeonly buffer M { TriangleDefects triangle_defects[2]; };
layout(binding = 13, scalar) writeonly buffer N { TriangleMasks triangle_masks[2]; };
layout(binding = 14, scalar) writeonly buffer O { VertexDefects vertex_defects[2]; };
layout(binding = 15, scalar) writeonly buffer P { VertexMasks vertex_masks[2]; };

void main() {
  for (uint i = 0; i < 2; ++i) {
    uint n = 100 * i;
    mesh_records[i].first_vertex = n + 1;
    mesh_records[i].vertex_count = n + 2;
    mesh_records[i].first_triangle = n + 3;
    mesh_records[i].triangle_count = n + 4;
    for (uint k = 0; k < 9; ++k) mesh_records[i].linear[k] = double(n + 5 + k);
    chunks[i] = Chunk(n + 1, n + 2, n + 3);
    geometry_totals[i].area = double(n + 1);
    geometry_totals[i].smallest_area = double(n + 2);
    geometry_totals[i].largest_area = double(n + 3);
    geometry_totals[i].largest_coordinate = double(n + 4);
    geometry_totals[i].kept = n + 5;
    geometry_totals[i].degenerate = n + 6;
    for (uint k = 0; k < 3; ++k) {
      geometry_totals[i].low[k] = float(n + 7 + k);
      geometry_totals[i].high[k] = float(n + 10 + k);
    }
    for (uint k = 0; k < 12; ++k) instances[i].world[k] = double(n + 1 + k);
    instances[i].first_block = n + 13;
    instances[i].block_count = n + 14;
    instances[i].first_output = n + 15;
    topology_totals[i] = TopologyTotals(n + 1, n + 2, n + 3, n + 4);
    planar_totals[i] = PlanarTotals(double(n + 1), n + 2, n + 3);
    sorted_ranges[i] = SortedRange(n + 1, n + 2, n + 3);
    class_ranges[i] = ClassRange(double(n + 1), double(n + 2), n + 3, n + 4);
    spectrum_parts[i] = SpectrumPart(double(n + 1), double(n + 2), double(n + 3), double(n + 4));
    short_signals[i] = ShortSignal(n + 1, n + 2, n + 3, n + 4);
    chirp_signals[i] = ChirpSignal(double(n + 1), n + 2, n + 3, n + 4, n + 5, n + 6, n + 7);
    segments[i] = Segment(n + 1, n + 2, n + 3);
    for (uint k = 0; k < kTriangleKinds; ++k) triangle_defects[i].counts[k] = n + 1 + k;
    for (uint k = 0; k < kMaskWords * kTriangleKinds; ++k) triangle_masks[i].words[k] = n + 1 + k;
    for (uint k = 0; k < 3; ++k) {
      vertex_defects[i].counts[k] = n + 1 + k;
      vertex_defects[i].low[k] = n + 4 + k;
      vertex_defects[i].high[k] = n + 7 + k;
    }
    for (uint k = 0; k < kMaskWords * kVertexKinds; ++k) vertex_masks[i].words[k] = n + 1 + k;
  }
}
