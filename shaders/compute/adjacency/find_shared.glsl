// find_shared.glsl — Half-edges on lists of more than two (see link_half_edges.comp). Needs buffer twin.
//
// Twins point at each other, list members do not; the last member of a list looks like a boundary, so the one before speaks for it.
#ifndef SCENE_ANALYZER_FIND_SHARED
#define SCENE_ANALYZER_FIND_SHARED

// How many half-edges h speaks for: itself, or itself and the last one, which is twin[h] then.
uint shared_through(uint h) {
  uint other = twin[h];
  if (other == kNone) return 0;
  uint back = twin[other];
  return back == h ? 0 : (back == kNone ? 2 : 1);
}

#endif
