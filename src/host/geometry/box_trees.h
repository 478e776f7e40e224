// box_trees.h — Whether any two points of two sets are near each other, without looking at every pair. Used
// by welding.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace scene_analyzer::geometry {

struct Point {
  std::array<float, 3> at;
  std::uint32_t vertex;
};

// points[first, first + count) and what encloses them.
struct Box {
  std::array<float, 3> low, high;
  std::uint32_t first, count;
  std::uint32_t left = 0, right = 0;  // nodes; both 0: a leaf of few points
};

// Trees over ranges of one array of points, built when first asked for. Building reorders points within their
// range.
class BoxTrees {
 public:
  struct Tree {
    std::uint32_t node = UINT32_MAX;
  };

  BoxTrees(std::vector<Point>& points, double squared_distance)
      : points_(points), squared_distance_(squared_distance) {}

  // The box of a whole range; remembered in `tree` when the range is large enough to deserve one. Cost: m log
  // m, once.
  Box root(Tree& tree, std::uint32_t first, std::uint32_t count) {
    if (count <= kLeafPoints) return enclose(first, count);
    if (tree.node == UINT32_MAX) tree.node = build(first, count);
    return nodes_[tree.node];
  }

  // Exactly what comparing every pair would give: rounding is monotonic, so the distance between two boxes is
  // at most, as computed, any computed distance between their points.
  bool any_within(const Box& a, const Box& b) const {
    if (least(a, b) > squared_distance_) return false;
    if (most(a, b) <= squared_distance_) return true;
    if (a.right == 0 && b.right == 0) return any_pair(a, b);
    // The wider one is split, down to its points: a crowd in the middle of a shell is then one box to all
    // points of the shell, while boxes of the shell, which are thicker than it, would reach into the crowd.
    const bool split_a = width(a) >= width(b);
    const Box& split = split_a ? a : b;
    const Box& whole = split_a ? b : a;
    if (split.right == 0) return any_point_within(split, whole);
    const Box* near = &nodes_[split.left];
    const Box* far = &nodes_[split.right];
    if (least(*far, whole) < least(*near, whole)) std::swap(near, far);
    return any_within(*near, whole) || any_within(*far, whole);
  }

 private:
  static constexpr std::uint32_t kLeafPoints = 8;

  static double square(double value) { return value * value; }

  Box enclose(std::uint32_t first, std::uint32_t count) const {
    Box box{points_[first].at, points_[first].at, first, count};
    for (std::uint32_t i = first + 1; i < first + count; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], points_[i].at[axis]);
        box.high[axis] = std::max(box.high[axis], points_[i].at[axis]);
      }
    return box;
  }

  std::uint32_t build(std::uint32_t first, std::uint32_t count) {
    Box box = enclose(first, count);
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(box);
    if (count <= kLeafPoints) return node;
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (double{box.high[axis]} - box.low[axis] > double{box.high[widest]} - box.low[widest]) widest = axis;
    const auto begin = points_.begin() + first;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count,
                     [widest](const Point& a, const Point& b) { return a.at[widest] < b.at[widest]; });
    box.left = build(first, half);
    box.right = build(first + half, count - half);
    nodes_[node] = box;
    return node;
  }

  static double least(const Box& a, const Box& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += square(std::max({0.0, double{b.low[axis]} - a.high[axis], double{a.low[axis]} - b.high[axis]}));
    return sum;
  }
  static double most(const Box& a, const Box& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += square(std::max(double{b.high[axis]} - a.low[axis], double{a.high[axis]} - b.low[axis]));
    return sum;
  }

  static double width(const Box& box) {
    double widest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      widest = std::max(widest, double{box.high[axis]} - box.low[axis]);
    return widest;
  }

  bool any_point_within(const Box& leaf, const Box& whole) const {
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
      if (any_within({points_[i].at, points_[i].at, i, 1}, whole)) return true;
    return false;
  }

  bool any_pair(const Box& a, const Box& b) const {
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i)
      for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum += square(double{points_[i].at[axis]} - points_[j].at[axis]);
        if (sum <= squared_distance_) return true;
      }
    return false;
  }

  std::vector<Point>& points_;
  double squared_distance_;
  std::vector<Box> nodes_;
};

}  // namespace scene_analyzer::geometry
