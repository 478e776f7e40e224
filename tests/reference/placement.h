// placement.h — What a world matrix does to a mesh's measures.
#pragma once

#include <optional>

#include "analysis/analysis.h"
#include "reference/triangles.h"

namespace scene_analyzer::reference {

// How an instance is analysed: in file coordinates with areas scaled (similarities), or in coordinates A p.
struct Placement {
  mesh::Matrix3 linear = mesh::kIdentity3;
  double area_scale = 1;
};
// Similarity: every entry of A^T A within 1e-6 s^2 of s^2 I, s^2 = trace / 3. A singular A never is one.
Placement placement_of(const mesh::Matrix4& world);

// Axis-aligned world bounds of kept triangles; absent when none is kept.
std::optional<analysis::Bounds> world_bounds(const Geometry& geometry, const TriangleMeasures& triangles,
                                             const mesh::Matrix4& world);

}  // namespace scene_analyzer::reference
