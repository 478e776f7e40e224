// defects.h — What is wrong with a mesh, by maps and sorting.
#pragma once

#include "analysis/defects.h"
#include "reference/adjacency.h"
#include "reference/geometry.h"
#include "reference/triangles.h"

namespace scene_analyzer::reference {

// Sorts triangles and edges: n log n. For a mesh with at least one triangle.
analysis::Defects find_defects(const Geometry& geometry, const TriangleMeasures& triangles,
                               const Adjacency& adjacency);

}  // namespace scene_analyzer::reference
