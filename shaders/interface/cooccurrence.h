// cooccurrence.h — Parameters of the co-occurrence room's kernels.
#ifndef SCENE_ANALYZER_INTERFACE_COOCCURRENCE_H
#define SCENE_ANALYZER_INTERFACE_COOCCURRENCE_H
#include "mesh.h"

INTERFACE_BEGIN(cooccurrence)

INTERFACE_CONST uint kClassBlock = 512;  // sorted areas per thread when classes are formed
// Attributes on edges with more than two triangles are whole numbers of 1 / kAttributeSteps. A batch has
// fewer than 2^31 half-edges: sums of so many multiples of 2^-22 up to 1, and of multiples of 2^-44 up to
// 2^-22, are exact in a double.
INTERFACE_CONST double kAttributeSteps = 4194304.0;
INTERFACE_CONST uint kBins = 64;  // per axis of the binned histogram

// Key: mesh, then exponent, then the leading bits of the mantissa of the area; all ones for degenerate
// triangles.
struct KeyParams {
  uint triangles;
  uint exponent_bits;
  uint mantissa_bits;
  uint least_exponent;  // biased, of the smallest kept area of the batch
};

// A mesh's kept triangles within the list of all sorted by area.
struct SortedRange {
  uint first;
  uint count;
  uint first_block;  // blocks of kClassBlock sorted areas
};

struct SortedParams {
  uint count;      // kept triangles of the batch
  uint triangles;  // all triangles of the batch
  uint blocks;
  uint meshes;
};

// The area classes of one mesh, numbered over the batch.
struct ClassRange {
  double lowest;   // attribute of the first class
  double highest;  // of the last
  uint first;
  uint count;  // 0 without a kept triangle
};

struct ContrastParams {
  uint chunk_count;
};

struct SharedValueParams {
  uint count;  // shared half-edges
};

// Histograms. A triangle's label is its row and column: the bin of its attribute, or the number of its
// attribute among the distinct ones of the batch.
struct LabelParams {
  uint triangles;
};

// Half-edges of shared edges sorted by key = begin of their edge << label_bits | label; equal keys form a
// run.
struct SharedLabelParams {
  uint count;  // shared half-edges
  uint label_bits;
};

struct SortedKeysParams {
  uint count;
};

struct MeshRunParams {
  uint count;   // shared half-edges
  uint meshes;  // of the batch; one thread more writes the end
};

struct NeighbourBinParams {
  uint first;       // half-edge
  uint count;       // half-edges
  uint first_mesh;  // histogram 0 belongs to this mesh
};

struct RunBinParams {
  uint first;  // run
  uint count;  // runs
  uint label_bits;
  uint first_mesh;
};

struct RunPairParams {
  uint runs;
  uint label_bits;
};

// A window of half-edges, or of pairs of runs.
struct PairParams {
  uint first;
  uint count;
  uint runs;  // where pairs of runs are listed
  uint label_bits;
};

INTERFACE_END
#endif
