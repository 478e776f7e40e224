// vertex_totals.glsl — An empty sum of VertexDefects, and what joins two.
#ifndef SCENE_ANALYZER_DEFECTS_VERTEX_TOTALS
#define SCENE_ANALYZER_DEFECTS_VERTEX_TOTALS

VertexDefects no_vertex() {
  VertexDefects empty;
  for (uint i = 0; i < 3; ++i) {
    empty.counts[i] = 0;
    empty.low[i] = 0xFFFFFFFFu;
    empty.high[i] = 0;
  }
  return empty;
}

void include_place(inout VertexDefects sum, uvec3 low, uvec3 high) {
  for (uint axis = 0; axis < 3; ++axis) {
    sum.low[axis] = min(sum.low[axis], low[axis]);
    sum.high[axis] = max(sum.high[axis], high[axis]);
  }
}

#endif
