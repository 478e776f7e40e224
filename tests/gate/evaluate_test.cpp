#include "gate/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gate/gate_fixture.h"
#include "gate/worst.h"

namespace scene_analyzer::gate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CheckResult check(const std::string& lines, const std::vector<AssetState>& assets,
                  const CheckOptions& options = {}) {
  return evaluate(one_rule(lines), assets, options);
}

const std::vector<TestMesh> kTable = {
    {"Top", "top", 40, 0.2, 0}, {"Leg 1", "leg", 120, 0.7, 1}, {"Leg 2", "leg", 120, 0.7, 1}};

TEST(Verdict, IsPassAtTheLimitAndFailBeyondIt) {
  const std::vector<AssetState> assets = {asset_of("t.glb", kTable)};
  EXPECT_EQ(check("max.triangles = 120", assets).rules[0].verdict, Verdict::kPass);
  EXPECT_FALSE(check("max.triangles = 120", assets).failed);
  const CheckResult failed = check("max.triangles = 119", assets);
  EXPECT_EQ(failed.rules[0].verdict, Verdict::kFail);
  EXPECT_TRUE(failed.failed);
  EXPECT_EQ(check("min.triangles = 40", assets).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check("min.triangles = 41", assets).rules[0].verdict, Verdict::kFail);
}

TEST(Verdict, NamesTheMeshOnceForAllItsInstances) {
  const CheckResult result = check("max.triangles = 50", {asset_of("t.glb", kTable)});
  ASSERT_EQ(result.worst.size(), 1U);
  EXPECT_EQ(result.worst[0].node, "Leg 1");
  EXPECT_EQ(result.worst[0].others, 1U);
  EXPECT_EQ(result.worst[0].value, 120);
  EXPECT_DOUBLE_EQ(result.worst[0].ratio(), 2.4);
  EXPECT_EQ(result.rules[0].checked, 2U);
  EXPECT_EQ(result.rules[0].meshes, 3U);
  EXPECT_EQ(result.errors, 1U);
}

TEST(Verdict, OfAnAssetLooksAtAllItsMeshesAndFiles) {
  const std::vector<AssetState> assets = {asset_of("t.glb", kTable)};
  EXPECT_EQ(check("max.asset_triangles = 279", assets).worst.at(0).value, 280);
  EXPECT_FALSE(check("max.asset_triangles = 279", assets).worst.at(0).mesh);
  EXPECT_EQ(check("max.file_bytes = 999", assets).worst.at(0).value, 1000);
  EXPECT_EQ(check("max.file_bytes = 1000", assets).rules[0].verdict, Verdict::kPass);
}

TEST(Verdict, OfAWarningNeverFailsTheGate) {
  const CheckResult result = check("severity = \"warning\"\nmax.triangles = 1", {asset_of("t.glb", kTable)});
  EXPECT_EQ(result.rules[0].verdict, Verdict::kFail);
  EXPECT_FALSE(result.failed);
  EXPECT_EQ(result.warnings, 2U);
  EXPECT_EQ(result.errors, 0U);
}

TEST(Verdict, IsUncheckedWhereGlobsMatchNothing) {
  const std::vector<AssetState> assets = {asset_of("t.glb", kTable)};
  const CheckResult no_asset = check("assets = \"other/*\"\nmax.triangles = 1", assets);
  EXPECT_EQ(no_asset.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_THAT(no_asset.rules[0].reasons.at(0).text, HasSubstr("match nothing"));
  const CheckResult no_mesh = check("meshes = \"Arm*\"\nmax.triangles = 1", assets);
  EXPECT_EQ(no_mesh.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_THAT(no_mesh.rules[0].reasons.at(0).text, HasSubstr("no mesh"));
  EXPECT_FALSE(no_mesh.failed);
  EXPECT_EQ(check("meshes = \"Leg 2\"\nmax.triangles = 1", assets).worst.at(0).node, "Leg 2");
}

TEST(Verdict, IsUncheckedForValuesThatAreMissing) {
  analysis::AssetAnalysis asset = analysis_of(kTable);
  asset.geometries[0].not_analysed = "needs more memory";
  asset.geometries[1].fourier_transform.reset();
  asset.geometries[1].no_fourier_transform = "the search had no memory";
  const CheckResult result =
      check("max.fourier_transform = 0.5\nmax.triangles = 500", {asset_of("t.glb", asset)});
  EXPECT_EQ(result.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_EQ(result.rules[0].checked, 1U);
  EXPECT_EQ(result.rules[0].unchecked, 3U);
  std::string reasons;
  for (const Reason& reason : result.rules[0].reasons) reasons += reason.text + "\n";
  EXPECT_THAT(reasons, HasSubstr("triangles: needs more memory"));
  EXPECT_THAT(reasons, HasSubstr("fourier_transform: the search had no memory"));
}

TEST(Verdict, OfAMeshWithoutTrianglesIsUnchecked) {
  const CheckResult result =
      check("max.polygons_per_planar_group = 0.5", {asset_of("t.glb", {{"E", "e", 0, 0, 0}})});
  EXPECT_EQ(result.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_EQ(result.rules[0].reasons.at(0).example, "t.glb: E");
}

TEST(Verdict, IsUncheckedWhereAFileIsMissing) {
  analysis::AssetAnalysis asset = analysis_of(kTable);
  asset.files[1].found = false;
  const CheckResult result = check("max.file_bytes = 5000", {asset_of("t.glb", asset)});
  EXPECT_EQ(result.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_THAT(result.rules[0].reasons.at(0).text, HasSubstr("a.bin"));
}

TEST(Verdict, OfAnAssetThatFailedIsUnchecked) {
  const std::vector<AssetState> assets = {failed_asset("bad.glb", "it is cut short"),
                                          asset_of("t.glb", kTable)};
  const CheckResult result = check("max.triangles = 500", assets);
  EXPECT_EQ(result.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_EQ(result.rules[0].reasons.at(0).text, "the asset could not be analysed");
  EXPECT_EQ(result.rules[0].reasons.at(0).example, "bad.glb");
  EXPECT_EQ(result.rules[0].checked, 2U);
  EXPECT_EQ(check("max.triangles = 5", assets).rules[0].verdict, Verdict::kFail)
      << "what fails is told first";
  EXPECT_EQ(check("assets = \"t*\"\nmax.triangles = 500", assets).rules[0].verdict, Verdict::kPass);
}

TEST(Verdict, ThatIsUncheckedFailsAStrictGate) {
  const std::vector<AssetState> assets = {asset_of("t.glb", kTable)};
  EXPECT_TRUE(check("meshes = \"x\"\nmax.triangles = 1", assets, {.strict = true}).failed);
  EXPECT_FALSE(
      check("severity = \"warning\"\nmeshes = \"x\"\nmax.triangles = 1", assets, {.strict = true}).failed);
  EXPECT_FALSE(check("max.triangles = 500", assets, {.strict = true}).failed);
}

TEST(TimedVerdict, OfACpuDeviceIsUncheckedUnlessItIsAllowed) {
  analysis::AssetAnalysis asset = analysis_of({{"Top", "top", 40, 0.2, 0}});
  set_time(asset, 3, "cpu");
  const std::vector<AssetState> assets = {asset_of("t.glb", asset, analysis::MetricSet().set())};
  const CheckResult result = check("max.rendering_time_ms = 2\nmax.rendering_time = 0.9", assets);
  EXPECT_EQ(result.rules[0].verdict, Verdict::kUnchecked);
  EXPECT_EQ(result.rules[0].unchecked, 2U);
  EXPECT_THAT(result.rules[0].reasons.at(0).text, HasSubstr("--allow-cpu-timing"));
  const CheckResult allowed = check("max.rendering_time_ms = 2", assets, {.allow_cpu_timing = true});
  EXPECT_EQ(allowed.rules[0].verdict, Verdict::kFail);
  EXPECT_EQ(allowed.worst.at(0).value, 3);
}

TEST(TimedVerdict, OfAGpuIsCheckedAndOneWithoutTimesIsNot) {
  analysis::AssetAnalysis asset = analysis_of({{"Top", "top", 40, 0.2, 0}});
  const auto verdict = [&](double limit) {
    return check("max.rendering_time_ms = " + std::to_string(limit),
                 {asset_of("t.glb", asset, analysis::MetricSet().set())})
        .rules[0]
        .verdict;
  };
  EXPECT_EQ(verdict(2), Verdict::kUnchecked);
  set_time(asset, 3, "discrete");
  EXPECT_EQ(verdict(2), Verdict::kFail);
  EXPECT_EQ(verdict(4), Verdict::kPass);
}

TEST(Findings, AreSortedByHowFarBeyondTheyAreErrorsFirst) {
  const Budget budget = parse_budget(R"(version = 1
[[rule]]
name = "w"
severity = "warning"
max.triangles = 1
[[rule]]
name = "e"
max.triangles = 30
max.defects.total = 0
)",
                                     "b");
  analysis::AssetAnalysis asset = analysis_of(kTable);
  asset.geometries[0].defects->found = {{analysis::Defect::kBoundaryEdges, 3, {0}}};
  const CheckResult result = evaluate(budget, std::vector{asset_of("t.glb", asset)}, {});
  std::vector<std::string> order;
  for (const Finding& one : result.worst) order.push_back(budget.rules[one.rule].name + " " + one.node);
  EXPECT_THAT(order, ElementsAre("e Top", "e Leg 1", "e Top", "w Leg 1", "w Top"));
  EXPECT_EQ(result.worst[0].limit.quantity, Quantity::kDefectTotal) << "nothing is farther than from 0";
}

TEST(Findings, AreCappedAndCountedInFull) {
  std::vector<TestMesh> meshes;
  for (std::uint32_t i = 0; i < 1500; ++i) meshes.push_back({"n", "m", 10 + i, 0.5, i});
  const CheckResult result = check("max.triangles = 5", {asset_of("t.glb", meshes)});
  EXPECT_EQ(result.errors, 1500U);
  EXPECT_EQ(result.rules[0].findings, 1500U);
  ASSERT_EQ(result.worst.size(), kMostFindings);
  EXPECT_EQ(result.worst.front().value, 1509);
  EXPECT_EQ(result.worst.back().value, 510);
  EXPECT_EQ(result.rules[0].worst.size(), kMostFindingsPerRule);
}

TEST(Reasons, AreCappedAndCountedInFull) {
  std::vector<TestMesh> meshes;
  for (std::uint32_t i = 0; i < 30; ++i) meshes.push_back({"n", "m", 10, 0.5, i});
  analysis::AssetAnalysis asset = analysis_of(meshes);
  for (int i = 0; i < 30; ++i) asset.geometries[i].not_analysed = "reason " + std::to_string(i);
  const CheckResult result = check("max.triangles = 5", {asset_of("t.glb", asset)});
  EXPECT_EQ(result.rules[0].reasons.size(), kMostReasons);
  std::uint64_t count = 0;
  for (const Reason& reason : result.rules[0].reasons) count += reason.count;
  EXPECT_EQ(count, 30U);
  EXPECT_EQ(result.unchecked, 30U);
}

TEST(Worst, HoldsTheFirstOfMany) {
  Worst<int> worst(3);
  for (const int i : {5, 1, 9, 3, 7, 2}) worst.add(i);
  EXPECT_THAT(worst.take(), ElementsAre(1, 2, 3));
  Worst<int> none(0);
  none.add(1);
  EXPECT_TRUE(none.take().empty());
}

TEST(PortablePath, IsTheSameOnEveryMachine) {
  EXPECT_EQ(portable_path("./props//chair.glb", "/home/a"), "props/chair.glb");
  EXPECT_EQ(portable_path("/home/a/props/chair.glb", "/home/a"), "props/chair.glb");
  EXPECT_EQ(portable_path("/home/b/chair.glb", "/home/a"), "../b/chair.glb");
  EXPECT_EQ(portable_path("../chair.glb", "/home/a"), "../chair.glb");
}

}  // namespace
}  // namespace scene_analyzer::gate
