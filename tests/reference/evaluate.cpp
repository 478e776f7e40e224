#include "reference/evaluate.h"

#include <cmath>

namespace scene_analyzer::reference {

Evaluation evaluate_stages(std::span<const float> positions, std::span<const std::uint32_t> indices,
                           const mesh::Matrix3& linear, const analysis::Parameters& parameters) {
  Evaluation result;
  result.representative = weld(positions, parameters.weld_tolerance);
  const Geometry geometry{positions, indices, result.representative, linear};
  result.triangles = measure_triangles(geometry);
  result.adjacency = find_adjacency(geometry, result.triangles.kept);
  result.groups = planar_groups(geometry, result.triangles, result.adjacency, parameters.alpha_degrees);
  result.classes = area_classes(result.triangles.area, result.triangles.kept, parameters.dim);
  result.contrast = cooccurrence_contrast(result.adjacency, result.classes);
  result.defects = find_defects(geometry, result.triangles, result.adjacency);
  return result;
}

analysis::GeometryAnalysis summarize(const Evaluation& evaluation, const mesh::Matrix3& linear) {
  analysis::GeometryAnalysis result;
  result.linear = linear;
  result.source_triangles = evaluation.triangles.kept.size();
  result.triangles = evaluation.triangles.kept_count;
  result.degenerate_triangles = result.source_triangles - result.triangles;
  result.surface_area = evaluation.triangles.surface_area;
  result.planar_groups = evaluation.groups.count;
  result.largest_planar_group = evaluation.groups.largest;
  result.components = evaluation.adjacency.components;
  result.isolated_triangles = evaluation.adjacency.isolated_triangles;
  result.non_manifold_edges = evaluation.adjacency.non_manifold_edges;
  result.boundary_edges = evaluation.adjacency.boundary_edges;
  result.area_classes = evaluation.classes.value.size();
  if (result.source_triangles > 0) result.defects = evaluation.defects;
  if (result.triangles == 0) return result;
  const auto n = static_cast<double>(result.triangles);
  result.polygons_per_planar_group =
      result.triangles == 1 ? 0 : static_cast<double>(result.triangles - evaluation.groups.count) / (n - 1);
  result.planar_group_variation = std::sqrt(static_cast<double>(evaluation.groups.squared_sizes)) / n;
  result.cooccurrence_contrast = evaluation.contrast.rating;
  return result;
}

analysis::GeometryAnalysis evaluate(std::span<const float> positions, std::span<const std::uint32_t> indices,
                                    const mesh::Matrix3& linear, const analysis::Parameters& parameters) {
  return summarize(evaluate_stages(positions, indices, linear, parameters), linear);
}

}  // namespace scene_analyzer::reference
