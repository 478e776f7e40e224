// adjacency.h — Half-edges that meet, and parameters of the adjacency room's kernels.
//
// twin[h] of a half-edge is
//   the other half-edge        on an edge with two triangles
//   kNone                      on a boundary edge, and for degenerate triangles
//   kShared | begin            on an edge with more than two triangles: where the edge begins in the list of
//   shared half-edges
//
// The list is sorted by edge (its lowest half-edge), then half-edge.
#ifndef SCENE_ANALYZER_INTERFACE_ADJACENCY_H
#define SCENE_ANALYZER_INTERFACE_ADJACENCY_H
#include "mesh.h"

INTERFACE_BEGIN(adjacency)

INTERFACE_CONST uint kShared = 0x80000000u;
INTERFACE_CONST uint kLocalProbes = 12;  // slots tried in a row before another random place is taken

struct HashParams {
  uint half_edges;
  uint slots;
  double slots_per_vertex;  // slots / vertices of the batch
};

struct LinkParams {
  uint slots;
};

struct TriangleParams {
  uint triangles;
};

struct SharedParams {
  uint count;  // shared half-edges; half-edges of the batch while they are counted and gathered
  uint slots;
  double slots_per_vertex;
};

struct TopologyParams {
  uint chunk_count;
};

// What one chunk, and in the end one mesh, adds up to.
struct TopologyTotals {
  uint components;  // lowest triangles of their component
  uint isolated;    // kept triangles without a neighbour
  uint boundary_edges;
  uint non_manifold_edges;
};

INTERFACE_END
#endif
