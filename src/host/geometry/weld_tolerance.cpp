#include "geometry/weld_tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "geometry/box_trees.h"

namespace scene_analyzer::geometry {
namespace {

// Below 1/sqrt(3), so that the diagonal of a cell stays within the tolerance after rounding; above 1/2, so
// that points within the tolerance are at most two columns apart.
constexpr double kEdgePerTolerance = 0.57;
constexpr double kReach = 2;
// Half the smallest difference of two floats: with smaller cells nothing changes but that columns overflow.
constexpr double kSmallestEdge = 0x1p-150;

// Columns of a cell along z, y and x. In double because they reach 10^84; where doubles no longer hold every
// column, different floats are far more than two columns apart, so that only equal coordinates are near each
// other there.
using Key = std::array<double, 3>;

struct Cell {
  Key key;
  std::uint32_t first;  // of its points
  BoxTrees::Tree tree;  // once it was compared
};

class Welder {
 public:
  Welder(std::span<const float> positions, double tolerance)
      : edge_(std::max(kEdgePerTolerance * tolerance, kSmallestEdge)),
        points_(finite_points(positions)),
        trees_(points_, tolerance * tolerance),
        vertex_count_(positions.size() / 3) {}

  std::vector<std::uint32_t> run() {
    sort_into_cells(0, points_.size(), 2);
    collect_cells();
    // Each pair of neighbours once: the later one in the order of keys is looked up from the earlier one.
    link_row(0, 0, 1);
    for (double along = 1; along <= kReach; ++along) link_row(0, along, -kReach);
    for (double down = 1; down <= kReach; ++down)
      for (double along = -kReach; along <= kReach; ++along) link_row(down, along, -kReach);
    return representatives();
  }

 private:
  static std::vector<Point> finite_points(std::span<const float> positions);
  double column(float coordinate) const { return std::floor(coordinate / edge_); }
  std::uint32_t end_of(std::size_t cell) const {
    return cell + 1 < cells_.size() ? cells_[cell + 1].first : static_cast<std::uint32_t>(points_.size());
  }
  void sort_into_cells(std::size_t first, std::size_t last, std::size_t axis);
  void collect_cells();
  void link_row(double down, double along, double from);
  void link(std::size_t a, std::size_t b);
  std::uint32_t find(std::size_t cell);
  Box box_of(std::size_t cell);
  std::vector<std::uint32_t> representatives();

  double edge_;
  std::vector<Point> points_;
  BoxTrees trees_;
  std::vector<Cell> cells_;            // ascending keys
  std::vector<std::uint32_t> parent_;  // disjoint sets of cells
  std::size_t vertex_count_;
};

std::vector<Point> Welder::finite_points(std::span<const float> positions) {
  std::vector<Point> points;
  points.reserve(positions.size() / 3);
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    if (std::isfinite(positions[i]) && std::isfinite(positions[i + 1]) && std::isfinite(positions[i + 2]))
      points.push_back(
          {{positions[i], positions[i + 1], positions[i + 2]}, static_cast<std::uint32_t>(i / 3)});
  return points;
}

// By z; each layer of equal columns by y; each row by x.
void Welder::sort_into_cells(std::size_t first, std::size_t last, std::size_t axis) {
  const auto begin = points_.begin();
  std::sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
            [axis](const Point& a, const Point& b) { return a.at[axis] < b.at[axis]; });
  if (axis == 0) return;
  while (first < last) {
    const double layer = column(points_[first].at[axis]);
    std::size_t end = first + 1;
    while (end < last && column(points_[end].at[axis]) == layer) ++end;
    if (end - first > 1) sort_into_cells(first, end, axis - 1);
    first = end;
  }
}

void Welder::collect_cells() {
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const auto& at = points_[i].at;
    const Key key = {column(at[2]), column(at[1]), column(at[0])};
    if (cells_.empty() || cells_.back().key != key) cells_.push_back({key, i, {}});
  }
  parent_.resize(cells_.size());
  std::iota(parent_.begin(), parent_.end(), 0U);
}

// Links every cell with those `down` layers and `along` rows on, from column `from` relative to its own to
// the reach. One sweep: the looked-up keys ascend as the cells do.
void Welder::link_row(double down, double along, double from) {
  std::size_t begin = 0;
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    const Key& own = cells_[cell].key;
    const Key start = {own[0] + down, own[1] + along, own[2] + from};
    const double last = own[2] + kReach;
    while (begin < cells_.size() && cells_[begin].key < start) ++begin;
    for (std::size_t other = begin; other < cells_.size(); ++other) {
      const Key& key = cells_[other].key;
      if (key[0] != start[0] || key[1] != start[1] || key[2] > last) break;
      link(cell, other);
    }
  }
}

void Welder::link(std::size_t a, std::size_t b) {
  const std::uint32_t root_a = find(a);
  const std::uint32_t root_b = find(b);
  if (root_a == root_b) return;
  const Box box_a = box_of(a);
  const Box box_b = box_of(b);
  if (trees_.any_within(box_a, box_b)) parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

std::uint32_t Welder::find(std::size_t cell) {
  auto root = static_cast<std::uint32_t>(cell);
  while (parent_[root] != root) root = parent_[root] = parent_[parent_[root]];
  return root;
}

Box Welder::box_of(std::size_t cell) {
  return trees_.root(cells_[cell].tree, cells_[cell].first, end_of(cell) - cells_[cell].first);
}

std::vector<std::uint32_t> Welder::representatives() {
  std::vector<std::uint32_t> result(vertex_count_);
  std::iota(result.begin(), result.end(), 0U);  // for the vertices that are not finite
  std::vector<std::uint32_t> lowest(cells_.size(), UINT32_MAX);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    std::uint32_t& least = lowest[find(cell)];
    for (std::uint32_t i = cells_[cell].first; i < end_of(cell); ++i)
      least = std::min(least, points_[i].vertex);
  }
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
    for (std::uint32_t i = cells_[cell].first; i < end_of(cell); ++i)
      result[points_[i].vertex] = lowest[find(cell)];
  return result;
}

}  // namespace

std::vector<std::uint32_t> weld_within(std::span<const float> positions, double tolerance) {
  if (!(tolerance > 0)) throw std::invalid_argument("the weld tolerance has to be above 0");
  if (positions.size() % 3 != 0 || positions.size() / 3 >= UINT32_MAX)
    throw std::invalid_argument("positions are three floats per vertex, for fewer than 2^32 - 1 vertices");
  return Welder(positions, tolerance).run();
}

}  // namespace scene_analyzer::geometry
