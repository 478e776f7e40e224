#include "cli/selftest.h"

#include <cmath>
#include <functional>
#include <utility>

#include "cli/selftest_meshes.h"
#include "pipeline/measure.h"

namespace scene_analyzer::cli {
namespace {

using analysis::GeometryAnalysis;

constexpr double kRatingTolerance = 1e-5;

struct Expectation {
  std::string value;
  double expected;
  double tolerance;
  std::function<std::optional<double>(const GeometryAnalysis&)> read;
};

Expectation count(std::string name, std::optional<std::uint64_t> GeometryAnalysis::*field,
                  std::uint64_t expected) {
  return {std::move(name), static_cast<double>(expected), 0, [field](const GeometryAnalysis& geometry) {
            const auto& value = geometry.*field;
            return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
          }};
}

Expectation triangles(std::uint64_t expected) {
  return {"triangles", static_cast<double>(expected), 0, [](const GeometryAnalysis& geometry) {
            return std::optional(static_cast<double>(geometry.triangles));
          }};
}

Expectation groups(std::uint64_t expected) {
  return count("planar_groups", &GeometryAnalysis::planar_groups, expected);
}

Expectation rating(analysis::Metric metric, std::optional<double> GeometryAnalysis::*field, double expected) {
  return {std::string(analysis::kMetricKeys[index_of(metric)]), expected, kRatingTolerance,
          [field](const GeometryAnalysis& geometry) { return geometry.*field; }};
}

Expectation per_group(double expected) {
  return rating(analysis::Metric::kPolygonsPerPlanarGroup, &GeometryAnalysis::polygons_per_planar_group,
                expected);
}
Expectation variation(double expected) {
  return rating(analysis::Metric::kPlanarGroupVariation, &GeometryAnalysis::planar_group_variation, expected);
}
Expectation contrast(double expected) {
  return rating(analysis::Metric::kCooccurrenceContrast, &GeometryAnalysis::cooccurrence_contrast, expected);
}

// Of all kinds together.
Expectation defects(std::uint64_t expected) {
  return {"defects", static_cast<double>(expected), 0,
          [](const GeometryAnalysis& geometry) -> std::optional<double> {
            if (!geometry.defects) return std::nullopt;
            double sum = 0;
            for (const analysis::FoundDefect& one : geometry.defects->found)
              sum += static_cast<double>(one.count);
            return sum;
          }};
}

struct Case {
  BuiltInMesh mesh;
  std::vector<Expectation> expectations;
};

std::vector<Case> make_cases() {
  const auto boundary = [](std::uint64_t n) {
    return count("boundary_edges", &GeometryAnalysis::boundary_edges, n);
  };
  const auto non_manifold = [](std::uint64_t n) {
    return count("non_manifold_edges", &GeometryAnalysis::non_manifold_edges, n);
  };
  const auto components = [](std::uint64_t n) {
    return count("components", &GeometryAnalysis::components, n);
  };
  std::vector<Case> cases;
  cases.push_back({cube(),
                   {triangles(12), groups(6), components(1), boundary(0), non_manifold(0), defects(0),
                    per_group(6.0 / 11)}});
  cases.push_back({prism(6, 5, 1, 3), {triangles(72), groups(8), per_group(64.0 / 71)}});
  cases.push_back({geosphere(2), {triangles(320), groups(320), per_group(0), boundary(0), defects(0)}});
  cases.push_back({split_tetrahedron(0), {triangles(4), groups(4), variation(0)}});
  cases.push_back({split_tetrahedron(1), {triangles(6), groups(4), variation(0.5)}});
  cases.push_back({split_tetrahedron(3), {triangles(30), groups(4), variation(0.9)}});
  cases.push_back(
      {flat_grid(4), {triangles(32), groups(1), boundary(16), per_group(1), variation(1), contrast(0)}});
  cases.push_back(
      {prism(10, 1, 0.03, 0.12),
       {triangles(40), groups(12), per_group(28.0 / 39), variation(std::sqrt(0.15)), contrast(1.0 / 3)}});
  cases.push_back({square_tube(0), {triangles(8), boundary(8), defects(8), contrast(0)}});
  cases.push_back({square_tube(1), {triangles(12), boundary(12), contrast(0.53303)}});
  cases.push_back({square_tube(2), {triangles(16), boundary(16), contrast(1)}});
  return cases;
}

mesh::Scene scene_of(const std::vector<BuiltInMesh>& meshes) {
  mesh::Scene scene;
  scene.asset = "built-in meshes";
  for (const BuiltInMesh& built_in : meshes) {
    mesh::TriangleMesh triangle_mesh;
    triangle_mesh.name = built_in.name;
    triangle_mesh.positions = built_in.positions;
    triangle_mesh.indices = built_in.indices;
    scene.instances.push_back(
        {static_cast<std::uint32_t>(scene.meshes.size()), built_in.name, mesh::kIdentity4});
    scene.meshes.push_back(std::move(triangle_mesh));
  }
  return scene;
}

}  // namespace

bool Check::good() const {
  return got && std::abs(*got - expected) <= tolerance;
}

std::vector<BuiltInMesh> selftest_meshes() {
  std::vector<BuiltInMesh> meshes;
  for (Case& one : make_cases()) meshes.push_back(std::move(one.mesh));
  return meshes;
}

std::vector<Check> compare(const std::vector<GeometryAnalysis>& measured) {
  std::vector<Check> checks;
  const std::vector<Case> cases = make_cases();
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const Expectation& expectation : cases[i].expectations) {
      Check check{cases[i].mesh.name, expectation.value, expectation.expected, std::nullopt,
                  expectation.tolerance};
      if (i < measured.size()) check.got = expectation.read(measured[i]);
      checks.push_back(std::move(check));
    }
  return checks;
}

std::vector<Check> run_selftest(gpu::Device& device) {
  const std::vector<BuiltInMesh> meshes = selftest_meshes();
  analysis::AssetAnalysis analysis;
  pipeline::Measurer measurer(device);
  const mesh::Scene scene = scene_of(meshes);
  measurer.measure({.scene = scene, .analysis = analysis});
  std::vector<GeometryAnalysis> measured;
  for (const auto& instance : analysis.instances)
    measured.push_back(analysis.geometries.at(instance.geometry));
  return compare(measured);
}

}  // namespace scene_analyzer::cli
