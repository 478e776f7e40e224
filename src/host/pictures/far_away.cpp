#include "pictures/far_away.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ratings/ratings.h"

namespace scene_analyzer::pictures {
namespace {

constexpr double kTooLarge = 1000;

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

}  // namespace

std::optional<FarAway> find_far_away(const scene_render::SceneModel& model) {
  std::vector<std::size_t> meshes;
  std::vector<analysis::Bounds> boxes;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (const auto box = model.box(i)) {
      meshes.push_back(i);
      boxes.push_back(*box);
    }
  if (boxes.size() < 3) return std::nullopt;
  FarAway found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> middles;
    for (const analysis::Bounds& box : boxes) middles.push_back(box.min[axis] / 2 + box.max[axis] / 2);
    found.others[axis] = median(std::move(middles));
  }
  std::vector<double> reaches;  // of each mesh, from the middle of all to its farthest corner
  for (const analysis::Bounds& box : boxes) {
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double reach = std::max(std::abs(box.min[axis] - found.others[axis]),
                                    std::abs(box.max[axis] - found.others[axis]));
      squares += reach * reach;
    }
    reaches.push_back(std::sqrt(squares));
  }
  const auto farthest = std::ranges::max_element(reaches);
  const double usual = median(reaches);
  if (!(*farthest > kTooLarge * usual)) return std::nullopt;
  analysis::Bounds around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.min[axis] = found.others[axis] - usual;
    around.max[axis] = found.others[axis] + usual;
  }
  found.eye = ratings::default_eye(around);
  found.mesh = meshes[static_cast<std::size_t>(farthest - reaches.begin())];
  return found;
}

}  // namespace scene_analyzer::pictures
