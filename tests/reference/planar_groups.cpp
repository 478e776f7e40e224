#include "reference/planar_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/disjoint_sets.h"

namespace scene_analyzer::reference {
namespace {

// long double keeps slivers (height 1e-6 of the longest edge) exact to 1e-13 rad.
using Real = long double;
using Vector = std::array<Real, 3>;
constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr Real kLeastTolerance = kPi / 18000;
constexpr Real kLargestTolerance = kPi / 180;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector scaled(const Vector& a, Real factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
Vector unit(const Vector& a) {
  return scaled(a, 1 / std::sqrt(dot(a, a)));
}

Vector between(const Geometry& geometry, std::uint32_t from, std::uint32_t to) {
  const mesh::Vector3 a = geometry.point(from);
  const mesh::Vector3 b = geometry.point(to);
  return {Real{b[0]} - Real{a[0]}, Real{b[1]} - Real{a[1]}, Real{b[2]} - Real{a[2]}};
}

// Not of unit length.
Vector normal_of(const Geometry& geometry, std::uint32_t triangle) {
  const std::uint32_t a = geometry.corner(triangle, 0);
  return cross(between(geometry, a, geometry.corner(triangle, 1)),
               between(geometry, a, geometry.corner(triangle, 2)));
}

bool runs_upwards(const Geometry& geometry, std::uint32_t half_edge) {
  return geometry.half_edge_from(half_edge) < geometry.half_edge_to(half_edge);
}

// Between the normals of the triangles of two half edges of one edge; one is flipped where the windings
// disagree.
Real normal_angle(const Geometry& geometry, std::uint32_t half_i, std::uint32_t half_j) {
  const Vector n_i = unit(normal_of(geometry, half_i / 3));
  Vector n_j = unit(normal_of(geometry, half_j / 3));
  if (runs_upwards(geometry, half_i) == runs_upwards(geometry, half_j)) n_j = scaled(n_j, -1);
  const Vector sine = cross(n_i, n_j);
  return std::atan2(std::sqrt(dot(sine, sine)), dot(n_i, n_j));
}

// What float32 coordinates allow two coplanar triangles of these heights to deviate.
Real tolerance(const TriangleMeasures& triangles, Real height_i, Real height_j) {
  const Real spacing = std::ldexp(Real{triangles.largest_coordinate}, -24);
  return std::clamp(4 * spacing * (1 / height_i + 1 / height_j), kLeastTolerance, kLargestTolerance);
}

Real least_height(const TriangleMeasures& triangles, std::span<const std::uint32_t> edge) {
  Real least = triangles.height[edge.front() / 3];
  for (const std::uint32_t half_edge : edge) least = std::min(least, Real{triangles.height[half_edge / 3]});
  return least;
}

Real full_turn_angle(Real angle) {
  return angle < 0 ? angle + 2 * kPi : angle >= 2 * kPi ? angle - 2 * kPi : angle;
}

// Direction of each triangle's third vertex about the edge, in [0, 2 pi).
std::vector<Real> directions_about(const Geometry& geometry, std::span<const std::uint32_t> edge) {
  const std::uint32_t origin = std::min(geometry.half_edge_from(edge[0]), geometry.half_edge_to(edge[0]));
  const std::uint32_t end = std::max(geometry.half_edge_from(edge[0]), geometry.half_edge_to(edge[0]));
  const Vector axis = unit(between(geometry, origin, end));
  std::size_t thinnest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(axis[k]) < std::abs(axis[thinnest])) thinnest = k;
  Vector helper{};
  helper[thinnest] = 1;
  const Vector side = unit(cross(axis, helper));
  const Vector up = cross(axis, side);
  std::vector<Real> directions;
  for (const std::uint32_t half_edge : edge) {
    const std::uint32_t apex = geometry.corner(half_edge / 3, (half_edge + 2) % 3);
    const Vector arm = between(geometry, origin, apex);
    directions.push_back(full_turn_angle(std::atan2(dot(arm, up), dot(arm, side))));
  }
  return directions;
}

struct Opposite {
  Real angle;  // of a triangle's direction, turned by pi
  std::uint32_t triangle;
};

// Joins intervals of the sorted opposites: each join is constant, and finish() links what lies inside any of
// them.
class IntervalLinks {
 public:
  IntervalLinks(std::vector<Opposite> sorted, DisjointSets& sets)
      : sorted_(std::move(sorted)), steps_(sorted_.size() + 1), sets_(sets) {}

  void join(std::uint32_t triangle, Real low, Real high) {
    const auto from = std::lower_bound(sorted_.begin(), sorted_.end(), low,
                                       [](const Opposite& o, Real angle) { return o.angle < angle; });
    const auto to = std::upper_bound(from, sorted_.end(), high,
                                     [](Real angle, const Opposite& o) { return angle < o.angle; });
    if (from == to) return;
    sets_.unite(triangle, from->triangle);
    ++steps_[static_cast<std::size_t>(from - sorted_.begin())];
    --steps_[static_cast<std::size_t>(to - sorted_.begin()) - 1];
  }

  void finish() {
    std::int64_t open = 0;
    for (std::size_t p = 0; p + 1 < sorted_.size(); ++p) {
      open += steps_[p];
      if (open > 0) sets_.unite(sorted_[p].triangle, sorted_[p + 1].triangle);
    }
  }

 private:
  std::vector<Opposite> sorted_;
  std::vector<std::int64_t> steps_;
  DisjointSets& sets_;
};

// After the flip rule the angle of i and j is that between i's direction and the opposite of j's, so i's
// partners are the opposites in one interval of the circle.
void link_fan(const Geometry& geometry, std::span<const std::uint32_t> edge, Real limit, DisjointSets& sets) {
  if (limit >= kPi) {
    for (const std::uint32_t half_edge : edge) sets.unite(edge[0] / 3, half_edge / 3);
    return;
  }
  const std::vector<Real> directions = directions_about(geometry, edge);
  std::vector<Opposite> opposites;
  for (std::size_t i = 0; i < edge.size(); ++i)
    opposites.push_back({full_turn_angle(directions[i] + kPi), edge[i] / 3});
  std::sort(opposites.begin(), opposites.end(),
            [](const Opposite& a, const Opposite& b) { return a.angle < b.angle; });
  IntervalLinks links(std::move(opposites), sets);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Real low = directions[i] - limit;
    const Real high = directions[i] + limit;
    links.join(edge[i] / 3, low, high);
    if (low < 0) links.join(edge[i] / 3, low + 2 * kPi, 2 * kPi);
    if (high >= 2 * kPi) links.join(edge[i] / 3, 0, high - 2 * kPi);
  }
  links.finish();
}

PlanarGroups collect(DisjointSets& sets, std::span<const std::uint8_t> kept) {
  PlanarGroups result{.group = std::vector<std::uint32_t>(kept.size(), kNone),
                      .size = std::vector<std::uint32_t>(kept.size())};
  for (std::uint32_t triangle = 0; triangle < kept.size(); ++triangle) {
    if (!kept[triangle]) continue;
    result.group[triangle] = sets.find(triangle);
    ++result.size[result.group[triangle]];
  }
  for (const std::uint64_t size : result.size) {
    if (size > 0) ++result.count;
    if (size > 1) result.squared_sizes += size * size;
    result.largest = std::max(result.largest, size);
  }
  return result;
}

}  // namespace

PlanarGroups planar_groups(const Geometry& geometry, const TriangleMeasures& triangles,
                           const Adjacency& adjacency, double alpha_degrees) {
  const Real alpha = Real{alpha_degrees} * kPi / 180;
  DisjointSets sets(triangles.kept.size());
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e) {
    const std::span<const std::uint32_t> edge = adjacency.edge(e);
    if (edge.size() == 2) {
      const Real limit =
          alpha + tolerance(triangles, triangles.height[edge[0] / 3], triangles.height[edge[1] / 3]);
      if (normal_angle(geometry, edge[0], edge[1]) <= limit) sets.unite(edge[0] / 3, edge[1] / 3);
    } else if (edge.size() > 2) {
      const Real least = least_height(triangles, edge);
      link_fan(geometry, edge, alpha + tolerance(triangles, least, least), sets);
    }
  }
  return collect(sets, triangles.kept);
}

PlanarGroups planar_groups_all_pairs(const Geometry& geometry, const TriangleMeasures& triangles,
                                     const Adjacency& adjacency, double alpha_degrees) {
  const Real alpha = Real{alpha_degrees} * kPi / 180;
  DisjointSets sets(triangles.kept.size());
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e) {
    const std::span<const std::uint32_t> edge = adjacency.edge(e);
    const Real least = least_height(triangles, edge);
    for (std::size_t i = 0; i < edge.size(); ++i)
      for (std::size_t j = i + 1; j < edge.size(); ++j) {
        const Real h_i = edge.size() > 2 ? least : Real{triangles.height[edge[i] / 3]};
        const Real h_j = edge.size() > 2 ? least : Real{triangles.height[edge[j] / 3]};
        if (normal_angle(geometry, edge[i], edge[j]) <= alpha + tolerance(triangles, h_i, h_j))
          sets.unite(edge[i] / 3, edge[j] / 3);
      }
  }
  return collect(sets, triangles.kept);
}

}  // namespace scene_analyzer::reference
