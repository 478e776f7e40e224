// evaluate.h — One mesh measured by the plain single-threaded twins: what the GPU's results are compared
// with.
#pragma once

#include <cstdint>
#include <span>

#include "analysis/analysis.h"
#include "reference/adjacency.h"
#include "reference/area_classes.h"
#include "reference/cooccurrence.h"
#include "reference/defects.h"
#include "reference/planar_groups.h"
#include "reference/triangles.h"
#include "reference/weld.h"

namespace scene_analyzer::reference {

// Every stage's result.
struct Evaluation {
  std::vector<std::uint32_t> representative;
  TriangleMeasures triangles;
  Adjacency adjacency;
  PlanarGroups groups;
  AreaClasses classes;
  Contrast contrast;
  analysis::Defects defects;
};

// `positions`: x, y, z per vertex; `indices`: three per triangle, each below the vertex count.
Evaluation evaluate_stages(std::span<const float> positions, std::span<const std::uint32_t> indices,
                           const mesh::Matrix3& linear = mesh::kIdentity3,
                           const analysis::Parameters& parameters = {});

// Every field but `mesh`, `fourier_transform` and `not_analysed`. Without a kept triangle counts are 0 and
// ratings absent.
analysis::GeometryAnalysis summarize(const Evaluation& evaluation,
                                     const mesh::Matrix3& linear = mesh::kIdentity3);

analysis::GeometryAnalysis evaluate(std::span<const float> positions, std::span<const std::uint32_t> indices,
                                    const mesh::Matrix3& linear = mesh::kIdentity3,
                                    const analysis::Parameters& parameters = {});

}  // namespace scene_analyzer::reference
