// compare.h — Measured analyses against the plain twin: counts equal, ratings within 1e-5, as promised to
// users.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "analysis/analysis.h"
#include "mesh/scene.h"
#include "pipeline/batching.h"
#include "reference/evaluate.h"
#include "reference/placement.h"
#include "reference/surface_distances.h"

namespace scene_analyzer::pipeline {

inline void expect_near(const std::optional<double>& found, const std::optional<double>& expected,
                        double tolerance) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (found) {
    EXPECT_NEAR(*found, *expected, tolerance);
  }
}

// One line per kind that was found.
inline std::string describe(const std::optional<analysis::Defects>& defects, bool with_places) {
  if (!defects) return "not looked for";
  std::string text;
  for (const analysis::FoundDefect& one : defects->found) {
    text += std::string(analysis::kDefectKeys[index_of(one.defect)]) + ' ' + std::to_string(one.count);
    for (const std::uint32_t place : one.places)
      if (with_places) text += ' ' + std::to_string(place);
    text += '\n';
  }
  return text;
}

inline void expect_same_measures(const analysis::GeometryAnalysis& found,
                                 const analysis::GeometryAnalysis& expected) {
  EXPECT_EQ(found.source_triangles, expected.source_triangles);
  EXPECT_EQ(found.degenerate_triangles, expected.degenerate_triangles);
  EXPECT_EQ(found.triangles, expected.triangles);
  EXPECT_EQ(found.source_triangles, found.triangles + found.degenerate_triangles);
  EXPECT_NEAR(found.surface_area, expected.surface_area, 1e-9 * expected.surface_area);
  expect_near(found.polygons_per_planar_group, expected.polygons_per_planar_group, 1e-5);
  expect_near(found.planar_group_variation, expected.planar_group_variation, 1e-5);
  expect_near(found.cooccurrence_contrast, expected.cooccurrence_contrast, 1e-5);
  EXPECT_EQ(describe(found.defects, false), describe(expected.defects, false));
  if (found.source_triangles == 0) return;  // in no batch: nothing was counted
  EXPECT_EQ(found.planar_groups, expected.planar_groups);
  EXPECT_EQ(found.largest_planar_group, expected.largest_planar_group);
  EXPECT_EQ(found.components, expected.components);
  EXPECT_EQ(found.isolated_triangles, expected.isolated_triangles);
  EXPECT_EQ(found.non_manifold_edges, expected.non_manifold_edges);
  EXPECT_EQ(found.boundary_edges, expected.boundary_edges);
  EXPECT_EQ(found.area_classes, expected.area_classes);
}

inline void expect_same_bounds(const std::optional<analysis::Bounds>& found,
                               const std::optional<analysis::Bounds>& expected) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (!found) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double scale = std::max(std::abs(expected->min[axis]), std::abs(expected->max[axis]));
    EXPECT_NEAR(found->min[axis], expected->min[axis], 1e-12 * scale);
    EXPECT_NEAR(found->max[axis], expected->max[axis], 1e-12 * scale);
  }
}

// The twin's search for start triangles takes all pairs: it looks at meshes up to this many triangles.
inline std::uint64_t most_triangles_for_all_pairs() {
  const char* asked = std::getenv("SCENE_ANALYZER_ALL_PAIRS");
#if defined(__SANITIZE_ADDRESS__)
  return asked ? std::stoull(asked) : 60;
#else
  return asked ? std::stoull(asked) : 500;
#endif
}

// Whether the twin looked at it.
inline bool expect_same_signal(const analysis::GeometryAnalysis& found, const reference::Geometry& geometry,
                               const reference::Evaluation& twin) {
  EXPECT_EQ(found.fourier_transform.has_value(), found.triangles > 0);
  EXPECT_EQ(found.signal.has_value(), found.triangles > 0);
  if (!found.signal || found.triangles > most_triangles_for_all_pairs()) return false;
  const auto arcs = reference::surface_arcs(geometry, twin.triangles, twin.adjacency);
  const auto expected = reference::surface_signal(twin.triangles, twin.adjacency, arcs);
  const std::vector<double> values = expected.values();
  EXPECT_EQ(found.signal->length, values.size());
  EXPECT_EQ(found.signal->gap, 0);
  EXPECT_NEAR(*found.fourier_transform, reference::fourier_rating(values), 1e-5);
  const auto& components = expected.components;
  if (components.empty()) return true;
  EXPECT_NEAR(found.signal->mean_distance * static_cast<double>(components[0].signal.size() - 1),
              components[0].total_distance, 1e-9 * components[0].total_distance);
  // Of components of the same size any may come first: their signals need not differ.
  if (components.size() == 1 || components[1].signal.size() < components[0].signal.size()) {
    EXPECT_EQ(found.signal->start_triangle, components[0].start);
  }
  return true;
}

// Returns how many geometries' start triangles the twin looked at.
inline std::size_t expect_agrees_with_twin(const mesh::Scene& scene, const analysis::Parameters& parameters,
                                           const analysis::AssetAnalysis& found) {
  EXPECT_EQ(found.instances.size(), scene.instances.size());
  if (found.instances.size() != scene.instances.size()) return 0;
  std::size_t all_pairs = 0;
  std::vector<std::optional<reference::Evaluation>> twins(found.geometries.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const analysis::InstanceAnalysis& instance = found.instances[i];
    const mesh::TriangleMesh& mesh = scene.meshes[scene.instances[i].mesh];
    SCOPED_TRACE(testing::Message() << scene.asset << ": node " << instance.node << ", mesh " << mesh.name);
    const reference::Placement placement = reference::placement_of(scene.instances[i].world);
    EXPECT_NEAR(instance.area_scale, placement.area_scale, 1e-12 * placement.area_scale);
    auto& twin = twins[instance.geometry];
    const bool first = !twin;
    if (first) {
      twin = reference::evaluate_stages(mesh.positions, mesh.indices, placement.linear, parameters);
      const auto expected = reference::summarize(*twin, placement.linear);
      expect_same_measures(found.geometries[instance.geometry], expected);
      EXPECT_EQ(describe(found.geometries[instance.geometry].defects, true),
                describe(expected.defects, true));
    }
    // The box is that of local coordinates under the whole matrix.
    const reference::Geometry geometry{mesh.positions, mesh.indices, twin->representative, placement.linear};
    if (first && expect_same_signal(found.geometries[instance.geometry], geometry, *twin)) ++all_pairs;
    expect_same_bounds(instance.bounds,
                       reference::world_bounds(geometry, twin->triangles, scene.instances[i].world));
  }
  return all_pairs;
}

}  // namespace scene_analyzer::pipeline
