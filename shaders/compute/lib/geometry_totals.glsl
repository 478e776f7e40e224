// geometry_totals.glsl — The monoid of GeometryTotals: an empty sum, a triangle, and two sums together.
#ifndef SCENE_ANALYZER_LIB_GEOMETRY_TOTALS
#define SCENE_ANALYZER_LIB_GEOMETRY_TOTALS

const float kBeyond = 3.402823466e38;

GeometryTotals no_geometry() {
  GeometryTotals empty;
  empty.area = 0.0LF;
  empty.smallest_area = 0.0LF;
  empty.largest_area = 0.0LF;
  empty.largest_coordinate = 0.0LF;
  empty.kept = 0;
  empty.degenerate = 0;
  for (uint axis = 0; axis < 3; ++axis) {
    empty.low[axis] = kBeyond;
    empty.high[axis] = -kBeyond;
  }
  return empty;
}

void add_triangle(inout GeometryTotals sum, bool kept, double area, double reach, vec3 low, vec3 high) {
  double smallest = sum.kept == 0 ? area : min(sum.smallest_area, area);
  sum.area += area;
  sum.smallest_area = kept ? smallest : sum.smallest_area;
  sum.largest_area = max(sum.largest_area, area);
  sum.largest_coordinate = kept ? max(sum.largest_coordinate, reach) : sum.largest_coordinate;
  sum.kept += kept ? 1 : 0;
  sum.degenerate += kept ? 0 : 1;
  for (uint axis = 0; axis < 3; ++axis) {
    sum.low[axis] = kept ? min(sum.low[axis], low[axis]) : sum.low[axis];
    sum.high[axis] = kept ? max(sum.high[axis], high[axis]) : sum.high[axis];
  }
}

void add_totals(inout GeometryTotals sum, GeometryTotals other) {
  double smallest = sum.kept == 0 ? other.smallest_area : min(sum.smallest_area, other.smallest_area);
  sum.area += other.area;
  sum.smallest_area = other.kept == 0 ? sum.smallest_area : smallest;
  sum.largest_area = max(sum.largest_area, other.largest_area);
  sum.largest_coordinate = max(sum.largest_coordinate, other.largest_coordinate);
  sum.kept += other.kept;
  sum.degenerate += other.degenerate;
  for (uint axis = 0; axis < 3; ++axis) {
    sum.low[axis] = min(sum.low[axis], other.low[axis]);
    sum.high[axis] = max(sum.high[axis], other.high[axis]);
  }
}

#endif
