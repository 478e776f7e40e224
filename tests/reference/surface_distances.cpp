#include "reference/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

namespace scene_analyzer::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-9;

double distance(const mesh::Vector3& a, const mesh::Vector3& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

std::vector<double> order_by_distance(std::vector<std::uint32_t> members,
                                      const std::vector<double>& distances,
                                      const std::vector<double>& areas) {
  double farthest = 0, largest = 0;
  for (const std::uint32_t t : members) {
    farthest = std::max(farthest, distances[t]);
    largest = std::max(largest, areas[t]);
  }
  const auto step = [](double value, double unit) { return unit > 0 ? std::round(value / unit * 1e9) : 0; };
  std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double da = step(distances[a], farthest), db = step(distances[b], farthest);
    if (da != db) return da < db;
    const double sa = step(areas[a], largest), sb = step(areas[b], largest);
    return sa != sb ? sa < sb : a < b;
  });
  std::vector<double> values;
  for (const std::uint32_t t : members) values.push_back(areas[t]);
  return values;
}

// -1, 0, 1: a before, with, behind b in the signal.
int compare(const SurfaceComponent& a, const SurfaceComponent& b, double unit) {
  if (a.signal.size() != b.signal.size()) return a.signal.size() > b.signal.size() ? -1 : 1;
  const double area_a = std::accumulate(a.signal.begin(), a.signal.end(), 0.0);
  const double area_b = std::accumulate(b.signal.begin(), b.signal.end(), 0.0);
  if (std::abs(area_a - area_b) > kTie * std::max(area_a, area_b)) return area_a > area_b ? -1 : 1;
  for (std::size_t i = 0; i < a.signal.size(); ++i) {
    const double x = std::round(a.signal[i] / unit * 1e9), y = std::round(b.signal[i] / unit * 1e9);
    if (x != y) return x < y ? -1 : 1;
  }
  return 0;
}

}  // namespace

std::uint32_t choose_start(std::span<const std::uint32_t> members, std::span<const double> totals,
                           std::span<const double> areas) {
  const double highest = *std::max_element(totals.begin(), totals.end());
  double smallest = kInfinity;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (totals[i] >= highest * (1 - kTie)) smallest = std::min(smallest, areas[members[i]]);
  for (std::size_t i = 0; i < members.size(); ++i)
    if (totals[i] >= highest * (1 - kTie) && areas[members[i]] <= smallest * (1 + kTie)) return members[i];
  return members.front();
}

SurfaceArcs surface_arcs(const Geometry& geometry, const TriangleMeasures& triangles,
                         const Adjacency& adjacency) {
  SurfaceArcs arcs;
  arcs.from.resize(geometry.triangle_count());
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e) {
    for (const std::uint32_t h : adjacency.edge(e)) {
      const mesh::Vector3 a = geometry.point(geometry.half_edge_from(h)),
                          b = geometry.point(geometry.half_edge_to(h));
      const mesh::Vector3 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
      for (const std::uint32_t other : adjacency.edge(e))
        if (other != h)
          arcs.from[h / 3].push_back({other / 3, distance(triangles.centroid[h / 3], middle) +
                                                     distance(middle, triangles.centroid[other / 3])});
    }
  }
  return arcs;
}

std::vector<double> surface_distances(const SurfaceArcs& arcs, std::uint32_t source) {
  std::vector<double> distances(arcs.from.size(), kInfinity);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distances[source] = 0;
  queue.emplace(0, source);
  while (!queue.empty()) {
    const auto [reached, triangle] = queue.top();
    queue.pop();
    if (reached > distances[triangle]) continue;
    for (const SurfaceArcs::Arc& arc : arcs.from[triangle]) {
      if (reached + arc.length >= distances[arc.target]) continue;
      distances[arc.target] = reached + arc.length;
      queue.emplace(distances[arc.target], arc.target);
    }
  }
  return distances;
}

double total_distance(const SurfaceArcs& arcs, std::uint32_t source) {
  double total = 0;
  for (const double d : surface_distances(arcs, source))
    if (d < kInfinity) total += d;
  return total;
}

SurfaceSignal surface_signal(const TriangleMeasures& triangles, const Adjacency& adjacency,
                             const SurfaceArcs& arcs) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < arcs.from.size(); ++t)
    if (!arcs.from[t].empty()) members[adjacency.component[t]].push_back(t);
  SurfaceSignal result;
  double largest = 0;
  for (const auto& [label, component] : members) {
    std::vector<double> totals;
    for (const std::uint32_t t : component) totals.push_back(total_distance(arcs, t));
    SurfaceComponent& measured = result.components.emplace_back();
    measured.start = choose_start(component, totals, triangles.area);
    measured.total_distance = total_distance(arcs, measured.start);
    measured.signal = order_by_distance(component, surface_distances(arcs, measured.start), triangles.area);
    for (const double area : measured.signal) largest = std::max(largest, area);
  }
  std::stable_sort(
      result.components.begin(), result.components.end(),
      [&](const SurfaceComponent& a, const SurfaceComponent& b) { return compare(a, b, largest) < 0; });
  return result;
}

std::vector<double> SurfaceSignal::values() const {
  std::vector<double> all;
  for (const SurfaceComponent& component : components)
    all.insert(all.end(), component.signal.begin(), component.signal.end());
  return all;
}

double fourier_rating(std::span<const double> signal) {
  const std::size_t n = signal.size(), c = n / 2;
  if (n < 2) return 0;
  std::vector<double> magnitudes;
  for (std::size_t k = 0; k <= c; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      sum += signal[i] *
             std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * i % n) / static_cast<double>(n));
    magnitudes.push_back(std::abs(sum));
  }
  double highest = 0, sum = 0, weighted = 0;
  for (std::size_t k = 1; k <= c; ++k) {
    highest = std::max(highest, magnitudes[k]);
    sum += magnitudes[k];
    weighted += static_cast<double>(k) * magnitudes[k];
  }
  if (sum <= 1e-12 * magnitudes[0]) return 0;
  return highest / magnitudes[0] * weighted / (static_cast<double>(c) * sum);
}

}  // namespace scene_analyzer::reference
