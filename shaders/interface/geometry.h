// geometry.h — Parameters of the geometry room's kernels.
#ifndef SCENE_ANALYZER_INTERFACE_GEOMETRY_H
#define SCENE_ANALYZER_INTERFACE_GEOMETRY_H
#include "types.h"

INTERFACE_BEGIN(geometry)

struct WeldParams {
  uint vertex_count;
  uint mesh_count;
  uint slots;        // size of the hash table, > vertex_count
};

struct ResolveParams {
  uint vertex_count;
};

// Chunks first_chunk .. first_chunk + chunk_count; partial results are written to the same indices.
struct ChunkParams {
  uint chunk_count;
};

struct CombineParams {
  uint chunk_count;   // chunks of this level
  uint first_input;   // where the level below begins among the partial results
  uint first_output;  // where this level begins
};

struct InstanceRecord {
  INTERFACE_ARRAY(double, world, 12);   // rows of the upper 3x4 of the world matrix
  uint first_chunk;                     // chunks of level 0 of the instance's mesh
  uint chunk_count;
};

struct InstanceBoundsParams {
  uint instance_count;
};

INTERFACE_END
#endif
