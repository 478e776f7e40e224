// label_runs.glsl — Runs of shared half-edges of one edge and one label. Needs buffers low, high, starts, firsts, ends and params.label_bits.
//
// A run stands for all triangles of its label on its edge, so that edges cost the square of their labels and never of their triangles.
#ifndef SCENE_ANALYZER_LIB_LABEL_RUNS
#define SCENE_ANALYZER_LIB_LABEL_RUNS

struct Edge {
  uint begin;  // in the list of shared half-edges
  uint first_run;
  uint end_run;
};

uint64_t key_of_run(uint run) { return (uint64_t(high[firsts[run]]) << 32) | uint64_t(low[firsts[run]]); }
uint label_of_run(uint run) { return uint(key_of_run(run) & ((uint64_t(1) << params.label_bits) - 1)); }
uint size_of_run(uint run) { return firsts[run + 1] - firsts[run]; }

Edge edge_of_run(uint run) {
  uint begin = uint(key_of_run(run) >> params.label_bits);
  return Edge(begin, starts[begin], starts[ends[begin]]);
}

// Ordered pairs of two different triangles, one of each run.
uint64_t pairs_of_runs(uint own, uint other) {
  uint others = size_of_run(other) - (own == other ? 1 : 0);
  return uint64_t(size_of_run(own)) * uint64_t(others);
}

#endif
