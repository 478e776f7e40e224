// The self-test's expectations hold for the plain C++ twins, and a wrong result is noticed.
#include "cli/selftest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reference/evaluate.h"

namespace scene_analyzer::cli {
namespace {

std::vector<analysis::GeometryAnalysis> measured_by_twins() {
  std::vector<analysis::GeometryAnalysis> measured;
  for (const BuiltInMesh& mesh : selftest_meshes())
    measured.push_back(reference::evaluate(mesh.positions, mesh.indices));
  return measured;
}

TEST(Selftest, TwinsAgreeWithEveryExpectation) {
  const auto checks = compare(measured_by_twins());
  EXPECT_GE(checks.size(), 30U);
  for (const Check& check : checks)
    EXPECT_TRUE(check.good()) << check.mesh << ' ' << check.value << ": expected " << check.expected
                              << ", got " << check.got.value_or(std::nan(""));
}

TEST(Selftest, EveryExpectationCanFail) {
  auto measured = measured_by_twins();
  for (auto& geometry : measured) {
    ++geometry.triangles;
    for (auto* count : {&geometry.planar_groups, &geometry.components, &geometry.non_manifold_edges,
                        &geometry.boundary_edges})
      *count = count->value() + 1;
    geometry.defects->found.push_back({analysis::Defect::kZeroArea, 1, {}});
    for (auto* rating : {&geometry.polygons_per_planar_group, &geometry.planar_group_variation,
                         &geometry.cooccurrence_contrast})
      *rating = rating->value() + 2e-5;
  }
  for (const Check& check : compare(measured)) EXPECT_FALSE(check.good()) << check.mesh << ' ' << check.value;
  for (const Check& check : compare({})) EXPECT_FALSE(check.good()) << check.mesh << ' ' << check.value;
}

TEST(SelftestMeshes, EveryEdgeIsWalkedOnceInEachDirection) {
  for (const BuiltInMesh& mesh : selftest_meshes()) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      for (std::size_t corner = 0; corner < 3; ++corner)
        EXPECT_TRUE(edges.emplace(mesh.indices[i + corner], mesh.indices[i + (corner + 1) % 3]).second)
            << mesh.name << ", triangle " << i / 3;
  }
}

}  // namespace
}  // namespace scene_analyzer::cli
