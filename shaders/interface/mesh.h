// mesh.h — How a batch of meshes lies in buffers. All index spaces run over the whole batch.
//
//   vertex v      position_x[v], position_y[v], position_z[v]: float32 as in the file (held as bits)
//   triangle t    corners[3 t + 0..2]: vertex indices
//   half-edge h   3 t + c, from corner c to corner (c + 1) % 3
//   chunk         a run of at most kChunkSize triangles of one mesh; one thread works through one chunk in
//   order, which
//                 makes sums reproducible and needs neither atomics nor shared memory
#ifndef SCENE_ANALYZER_INTERFACE_MESH_H
#define SCENE_ANALYZER_INTERFACE_MESH_H
#include "types.h"

INTERFACE_BEGIN(mesh)

INTERFACE_CONST uint kChunkSize = 64;  // triangles per chunk, and partial results per chunk of a higher level
INTERFACE_CONST uint kNone = 0xFFFFFFFFu;

struct MeshRecord {
  uint first_vertex;
  uint vertex_count;
  uint first_triangle;
  uint triangle_count;
  INTERFACE_ARRAY(double, linear, 9);  // row-major, applied to positions when the batch is transformed
};

struct Chunk {
  uint first;  // first triangle, or first partial result of the level below
  uint count;  // 1..kChunkSize
  uint mesh;   // index in the batch
};

// What one chunk, and in the end one mesh, adds up to after its triangles have been measured.
struct GeometryTotals {
  double area;           // sum over kept triangles
  double smallest_area;  // of a kept triangle; 0 without one
  double largest_area;
  double largest_coordinate;  // largest |coordinate| of the analysed positions of kept triangles
  uint kept;
  uint degenerate;
  INTERFACE_ARRAY(float, low, 3);   // bounds of kept triangles in local coordinates
  INTERFACE_ARRAY(float, high, 3);  // low > high without a kept triangle
};

INTERFACE_END
#endif
