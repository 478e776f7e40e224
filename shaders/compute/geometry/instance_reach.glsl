// instance_reach.glsl — How far a box, or a chunk of triangles, reaches along a world axis.
//
// Needs buffers chunks (level 0), totals (of all levels), corners, areas, instances and positions.glsl.
#ifndef SCENE_ANALYZER_INSTANCE_REACH
#define SCENE_ANALYZER_INSTANCE_REACH

const double kNowhere = -1.7e308LF;

// A direction in the world: an axis and a side, 0 the lower one, whose coordinates are negated so that both look for a maximum.
struct Direction {
  dvec3 row;
  double offset;
  double sign;
};

Direction direction_of(uint instance, uint which) {
  uint axis = which / 2;
  return Direction(dvec3(instances[instance].world[4 * axis], instances[instance].world[4 * axis + 1],
                         instances[instance].world[4 * axis + 2]),
                   instances[instance].world[4 * axis + 3], which % 2 == 0 ? -1.0LF : 1.0LF);
}

double reach(dvec3 p, Direction d) {
  precise double coordinate = d.row.x * p.x + d.row.y * p.y + d.row.z * p.z + d.offset;
  return d.sign * coordinate;
}

double reach_of_box(uint index, Direction d) {
  dvec3 low = dvec3(totals[index].low[0], totals[index].low[1], totals[index].low[2]);
  dvec3 high = dvec3(totals[index].high[0], totals[index].high[1], totals[index].high[2]);
  dvec3 corner = dvec3(d.sign * d.row.x > 0.0LF ? high.x : low.x, d.sign * d.row.y > 0.0LF ? high.y : low.y,
                       d.sign * d.row.z > 0.0LF ? high.z : low.z);
  double farthest = reach(corner, d);
  // Room for rounding, so that a box never promises less than a corner inside delivers.
  double size = abs(d.row.x * corner.x) + abs(d.row.y * corner.y) + abs(d.row.z * corner.z) + abs(d.offset);
  return totals[index].kept == 0 ? kNowhere : farthest + 1e-14LF * size;
}

double reach_of_chunk(uint index, Direction d) {
  double best = kNowhere;
  uint last = chunks[index].first + chunks[index].count;
  for (uint t = chunks[index].first; t < last; ++t) {
    for (uint c = 0; c < 3; ++c) {
      double candidate = reach(local_position(corners[3 * t + c]), d);
      best = areas[t] > 0.0LF ? max(best, candidate) : best;
    }
  }
  return best;
}

#endif
