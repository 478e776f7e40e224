// geometry.h — Parameters of the geometry room's kernels.
#ifndef SCENE_ANALYZER_INTERFACE_GEOMETRY_H
#define SCENE_ANALYZER_INTERFACE_GEOMETRY_H
#include "types.h"

INTERFACE_BEGIN(geometry)

struct WeldParams {
  uint vertex_count;
  uint mesh_count;
  uint slots;  // size of the hash table, > vertex_count
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
  INTERFACE_ARRAY(double, world, 12);  // rows of the upper 3x4 of the world matrix
  uint first_block;                    // chunks of level 1 of the instance's mesh
  uint block_count;
  uint first_output;  // blocks of the instances before
  uint padding;
};

struct InstanceBoundsParams {
  uint instance_count;
  uint output_count;  // blocks of all instances
  uint first_block;   // where level 1 begins among the partial results
};

INTERFACE_END
#endif
