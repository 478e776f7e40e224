// candidates.h — What is known about each triangle's total distance, and which triangles may still be the
// start.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace scene_analyzer::surface_distances {

inline constexpr double kTie = 1e-9;  // relative: totals that differ by less are equal
inline constexpr std::size_t kLandmarks = 16;

class Candidates {
 public:
  explicit Candidates(std::uint32_t count)
      : upper_(count, std::numeric_limits<double>::infinity()),
        searched_(count, 0),
        landmarks_(count),
        nearest_(count, std::numeric_limits<float>::infinity()) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(upper_.size()); }
  double upper(std::uint32_t v) const { return upper_[v]; }
  double best() const { return best_; }
  double threshold() const { return best_ * (1 - kTie); }
  bool is_searched(std::uint32_t v) const { return searched_[v] != 0; }
  bool is_open(std::uint32_t v) const { return searched_[v] == 0 && upper_[v] >= threshold(); }
  std::vector<std::uint32_t> open() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t v = 0; v < count(); ++v)
      if (is_open(v)) result.push_back(v);
    return result;
  }
  // Searched triangles whose total equals the best.
  std::vector<std::uint32_t> winners() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t v = 0; v < count(); ++v)
      if (searched_[v] != 0 && upper_[v] >= threshold()) result.push_back(v);
    return result;
  }

  void set_total(std::uint32_t v, double total) {
    upper_[v] = total;
    searched_[v] = 1;
    best_ = std::max(best_, total);
  }
  void lower_upper(std::uint32_t v, double bound) {
    if (searched_[v] == 0) upper_[v] = std::min(upper_[v], bound);
  }
  // `distances`: from a node of the given total to all. Of the n differences between two triangles' distances
  // to the others that to themselves cancel out, which leaves n - 2 of at most their own distance. So, too,
  // for an edge's node and a triangle; for one that hangs on this edge alone the bound is its total.
  void bound_all(double total, std::span<const double> distances) {
    const auto n = static_cast<double>(count()) - 2;
    for (std::uint32_t v = 0; v < count(); ++v) {
      if (searched_[v] == 0) upper_[v] = std::min(upper_[v], total + n * distances[v]);
      nearest_[v] = std::min(nearest_[v], static_cast<float>(distances[v]));
    }
    if (landmark_count_ == kLandmarks) return;
    for (std::uint32_t v = 0; v < count(); ++v)
      landmarks_[v][landmark_count_] = static_cast<float>(distances[v]);
    ++landmark_count_;
  }

  // Distance to the nearest source, of triangles that are none.
  float nearest(std::uint32_t v) const { return nearest_[v]; }
  // Not a source, and farthest from all that are.
  std::uint32_t farthest() const {
    return static_cast<std::uint32_t>(std::ranges::max_element(nearest_) - nearest_.begin());
  }
  // Distance to the first source.
  float landmark_distance(std::uint32_t v) const { return landmarks_[v][0]; }
  // About the distance of two triangles, and but for rounding never more: the largest difference of their
  // distances to landmarks.
  float about_distance(std::uint32_t a, std::uint32_t b) const {
    float most = 0;
    for (std::size_t i = 0; i < kLandmarks; ++i)
      most = std::max(most, std::fabs(landmarks_[a][i] - landmarks_[b][i]));
    return most;
  }

 private:
  std::vector<double> upper_;  // of searched ones the total itself
  std::vector<std::uint8_t> searched_;
  std::vector<std::array<float, kLandmarks>> landmarks_;  // distances to the first sources
  std::vector<float> nearest_;                            // distance to the nearest source
  std::size_t landmark_count_ = 0;
  double best_ = 0;
};

}  // namespace scene_analyzer::surface_distances
