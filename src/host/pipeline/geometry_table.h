// geometry_table.h — Which geometries of a scene have to be measured: instances that look alike share one.
#pragma once

#include <optional>
#include <vector>

#include "analysis/analysis.h"
#include "mesh/scene.h"

namespace scene_analyzer::pipeline {

// s^2 when the upper 3x3 of `world` is a similarity: A^T A within 1e-6 s^2 of s^2 I, mirrored or not, s > 0.
std::optional<double> similarity_scale_squared(const mesh::Matrix4& world);

mesh::Matrix3 linear_part(const mesh::Matrix4& world);

// The scene's instances in order, and the distinct (mesh, linear part) pairs that they need, in order of
// first use. Instances under similarities share the pair (mesh, identity) and carry s^2; others have a pair
// of their own per linear part, compared bit by bit. Bounds are left absent. Cost: n log n in instances, and
// every mesh is hashed once.
struct GeometryTable {
  std::vector<analysis::GeometryAnalysis> geometries;  // mesh, linear, shape_hash, source_triangles filled
  std::vector<analysis::InstanceAnalysis> instances;
};
GeometryTable make_geometry_table(const mesh::Scene& scene);

// World bounds of local bounds, where that is exact: each world axis depends on one local axis alone. Nothing
// otherwise.
std::optional<analysis::Bounds> carry_bounds(const analysis::Bounds& local, const mesh::Matrix4& world);

}  // namespace scene_analyzer::pipeline
