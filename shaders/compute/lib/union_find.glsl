// union_find.glsl — Lock-free union-find; the root of a set is its lowest member, whatever the order of threads.
//
// Needs a coherent buffer `parent`. Hooks the higher root below the lower one (compare Jaiganesh and Burtscher, ECL-CC, 2018).
#ifndef SCENE_ANALYZER_LIB_UNION_FIND
#define SCENE_ANALYZER_LIB_UNION_FIND

uint find_root(uint x) {
  uint above = parent[x];
  while (above != x) {
    uint next = parent[above];
    parent[x] = next;  // halves the path; a lost race leaves an older, still valid ancestor
    x = above;
    above = next;
  }
  return x;
}

void unite(uint a, uint b) {
  uint low = find_root(a), high = find_root(b);
  while (low != high) {
    uint lower = min(low, high), higher = max(low, high);
    uint found = atomicCompSwap(parent[higher], higher, lower);
    // Either higher was still a root, and is hooked now, or somebody else hooked it: go on from there.
    low = lower;
    high = found == higher ? lower : find_root(found);
  }
}

#endif
