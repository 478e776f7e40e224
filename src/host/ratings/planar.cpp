// planar.cpp — The two ratings that follow from planar groups.
#include <cmath>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {

double polygons_per_planar_group(std::uint64_t triangles, std::uint64_t groups) {
  if (triangles <= 1) return 0;
  // Integer difference first: exact for any count.
  return static_cast<double>(triangles - groups) / static_cast<double>(triangles - 1);
}

double planar_group_variation(std::uint64_t triangles, double squared_sizes) {
  if (triangles == 0) return 0;
  return std::sqrt(squared_sizes) / static_cast<double>(triangles);
}

}  // namespace scene_analyzer::ratings
