#include "reference/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace scene_analyzer::reference {
namespace {

using analysis::Defect;

// Counts and all places of each kind.
class Findings {
 public:
  void add(Defect defect, std::uint32_t place) {
    ++counts_[analysis::index_of(defect)];
    places_[analysis::index_of(defect)].insert(place);
  }
  void add(Defect defect) { ++counts_[analysis::index_of(defect)]; }

  analysis::Defects result() const {
    analysis::Defects defects;
    for (std::size_t kind = 0; kind < analysis::kDefectCount; ++kind) {
      if (counts_[kind] == 0) continue;
      std::vector<std::uint32_t> places(places_[kind].begin(), places_[kind].end());
      places.resize(std::min(places.size(), analysis::kMostDefectPlaces));
      defects.found.push_back({static_cast<Defect>(kind), counts_[kind], std::move(places)});
    }
    return defects;
  }

 private:
  std::array<std::uint64_t, analysis::kDefectCount> counts_{};
  std::array<std::set<std::uint32_t>, analysis::kDefectCount> places_;
};

void look_at_triangles(const Geometry& geometry, const TriangleMeasures& triangles,
                       const Adjacency& adjacency, Findings& findings) {
  std::set<std::array<std::uint32_t, 3>> seen;
  for (std::uint32_t t = 0; t < geometry.triangle_count(); ++t) {
    std::array<std::uint32_t, 3> corners = {geometry.corner(t, 0), geometry.corner(t, 1),
                                            geometry.corner(t, 2)};
    std::ranges::sort(corners);
    if (!triangles.kept[t]) {
      const bool equal = corners[0] == corners[1] || corners[1] == corners[2];
      findings.add(equal ? Defect::kDegenerateByIndex : Defect::kDegenerateByShape, t);
      continue;
    }
    if (!seen.insert(corners).second) findings.add(Defect::kDuplicateTriangles, t);
    if (adjacency.neighbours[t] == 0) findings.add(Defect::kIsolatedTriangles, t);
  }
  if (triangles.kept_count == 0) findings.add(Defect::kZeroArea);
}

void look_at_edges(const Geometry& geometry, const Adjacency& adjacency, Findings& findings) {
  for (std::size_t e = 0; e < adjacency.edge_count(); ++e) {
    const auto edge = adjacency.edge(e);
    const std::uint32_t lowest = edge.front() / 3;
    if (edge.size() == 1) findings.add(Defect::kBoundaryEdges, lowest);
    if (edge.size() > 2) findings.add(Defect::kNonManifoldEdges, lowest);
    if (edge.size() == 2 && geometry.half_edge_from(edge[0]) == geometry.half_edge_from(edge[1]))
      findings.add(Defect::kInconsistentWinding, lowest);
  }
}

// The distance to the next float32 above a magnitude, as if there were no smallest exponent.
double step_at(float magnitude) {
  int exponent = 0;
  const double mantissa = std::frexp(double{magnitude}, &exponent);  // [1/2, 1)
  const auto normal = static_cast<float>(mantissa);
  return std::ldexp(double{std::nextafter(normal, 2.0F)} - double{normal}, exponent);
}

void look_at_vertices(const Geometry& geometry, Findings& findings) {
  std::vector<bool> used(geometry.representative.size());
  for (const std::uint32_t v : geometry.indices) used[v] = true;
  std::array<std::vector<float>, 3> axes;  // coordinates of finite vertices in use
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    const auto place = geometry.positions.subspan(3 * std::size_t{v}, 3);
    const bool finite = std::ranges::all_of(place, [](float x) { return std::isfinite(x); });
    if (!used[v]) findings.add(Defect::kUnreferencedVertices, v);
    if (!finite) findings.add(Defect::kNonFiniteVertices, v);
    if (geometry.representative[v] != v) findings.add(Defect::kMergeableVertices, v);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (finite && used[v]) axes[axis].push_back(place[axis]);
  }
  float farthest = 0;
  double extent = 0;
  for (const auto& axis : axes) {
    if (axis.empty()) return;
    const auto [low, high] = std::ranges::minmax(axis);
    farthest = std::max({farthest, std::abs(low), std::abs(high)});
    extent = std::max(extent, double{high} - double{low});
  }
  if (farthest > 0 && extent < 1024 * step_at(farthest)) findings.add(Defect::kFarFromOrigin);
}

}  // namespace

analysis::Defects find_defects(const Geometry& geometry, const TriangleMeasures& triangles,
                               const Adjacency& adjacency) {
  Findings findings;
  look_at_triangles(geometry, triangles, adjacency, findings);
  look_at_edges(geometry, adjacency, findings);
  look_at_vertices(geometry, findings);
  return findings.result();
}

}  // namespace scene_analyzer::reference
