#include "ratings/ratings.h"
#include "ratings/unit_range.h"

namespace scene_analyzer::ratings {

std::vector<double> rendering_time_ratings(std::span<const double> times) {
  return onto_unit_range(times, 0);
}

}  // namespace scene_analyzer::ratings
