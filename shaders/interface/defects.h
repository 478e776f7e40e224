// defects.h — What the defects room's kernels find, per chunk of triangles and per chunk of vertices.
//
// Kinds are numbered in the order of analysis::Defect: triangles' first, then vertices'. Of each chunk there
// are a count per kind, which the chunk tree adds up, and a mask per kind: bit i % 32 of word i / 32 stands
// for the chunk's i-th triangle or vertex.
#ifndef SCENE_ANALYZER_INTERFACE_DEFECTS_H
#define SCENE_ANALYZER_INTERFACE_DEFECTS_H
#include "types.h"

INTERFACE_BEGIN(defects)

INTERFACE_CONST uint kTriangleKinds = 7;
INTERFACE_CONST uint kVertexKinds = 3;
INTERFACE_CONST uint kMaskWords = 2;  // kChunkSize bits

struct TriangleDefects {
  INTERFACE_ARRAY(uint, counts, 7);  // of triangles, or of edges that begin at a triangle of the chunk
};

struct TriangleMasks {
  INTERFACE_ARRAY(uint, words, 14);  // kMaskWords of the first kind, then of the second, ...
};

// Coordinates are those of finite vertices that triangles use, as ordered_bits() (lib/float_bits.glsl).
struct VertexDefects {
  INTERFACE_ARRAY(uint, counts, 3);
  INTERFACE_ARRAY(uint, low, 3);
  INTERFACE_ARRAY(uint, high, 3);  // below low without such a vertex
};

struct VertexMasks {
  INTERFACE_ARRAY(uint, words, 6);
};

struct RepeatParams {
  uint triangles;
  uint slots;  // of the table of triangles, > those in it
};

struct FindParams {
  uint chunk_count;
  uint slots;  // as above
};

INTERFACE_END
#endif
