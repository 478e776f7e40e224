// area_classes.glsl — Where the class that starts at a place ends. Needs buffer sorted.
#ifndef SCENE_ANALYZER_LIB_AREA_CLASSES
#define SCENE_ANALYZER_LIB_AREA_CLASSES

// Areas that differ by at most this, relative to the larger, are one value.
const double kSameArea = 1.19209e-07LF;

bool same_class(double start, double value) { return value - start <= kSameArea * value; }

// First place in (low, high] that is not in the class of `start`, given that place `low` is and place `high` is not (or is the end).
uint class_end(double start, uint low, uint high) {
  while (high - low > 1) {
    uint middle = low + (high - low) / 2;
    if (same_class(start, sorted[middle])) low = middle; else high = middle;
  }
  return high;
}

#endif
