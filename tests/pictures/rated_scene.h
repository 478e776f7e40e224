// rated_scene.h — A rated scene made of numbers.
#pragma once

#include <optional>
#include <vector>

#include "analysis/analysis.h"
#include "ratings/ratings.h"

namespace scene_analyzer::test {

// One mesh instance per value, which is its relative density and, its absolute value, its aggregate.
inline ratings::SceneRating rated(const std::vector<std::optional<double>>& values) {
  ratings::SceneRating rating;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ratings::MeshRating mesh;
    mesh.instance = i;
    mesh.ratings[index_of(analysis::Metric::kRelativeDensity)] = values[i];
    if (values[i]) {
      mesh.relative_ratings[index_of(analysis::Metric::kRelativeDensity)] = *values[i] / 2;
      mesh.aggregate = *values[i] < 0 ? -*values[i] : *values[i];
    }
    rating.meshes.push_back(mesh);
    rating.drawn_triangles += 1000;
  }
  return rating;
}

}  // namespace scene_analyzer::test
