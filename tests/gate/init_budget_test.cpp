#include "gate/init_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gate/evaluate.h"
#include "gate/gate_fixture.h"

namespace scene_analyzer::gate {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(InitBudget, IsPassedByWhatItWasMadeOf) {
  analysis::AssetAnalysis odd = analysis_of({{"a", "a", 12345, 0.123456, 0}, {"b", "b", 3, 1, 1}});
  odd.geometries[0].defects->found = {{analysis::Defect::kBoundaryEdges, 12345, {0}}};
  odd.geometries[1].cooccurrence_contrast = 0.999999;
  odd.geometries[1].fourier_transform = 0.25;
  const std::vector<AssetState> assets = {asset_of("a.glb", odd), asset_of("b.glb", {{"c", "c", 99, 0, 0}}),
                                          failed_asset("c.glb", "broken")};
  const Budget budget = parse_budget(init_budget(assets), "init");
  const CheckResult result = evaluate(budget, std::span(assets).first(2), {});
  EXPECT_FALSE(result.failed) << init_budget(assets);
  EXPECT_EQ(result.errors, 0U);
  EXPECT_GT(result.checked, 10U);
}

TEST(InitBudget, RoundsUp) {
  analysis::AssetAnalysis asset = analysis_of({{"a", "a", 12345, 0.123456, 0}});
  asset.geometries[0].defects->found = {{analysis::Defect::kBoundaryEdges, 12345, {0}}};
  const std::string text = init_budget(std::vector{asset_of("a.glb", asset)});
  EXPECT_THAT(text, HasSubstr("\nmax.triangles = 13000\n"));
  EXPECT_THAT(text, HasSubstr("\nmax.file_bytes = 1000\n"));
  EXPECT_THAT(text, HasSubstr("\nmax.polygons_per_planar_group = 0.13\n"));
  EXPECT_THAT(text, HasSubstr("\nmax.relative_density = 0.01\n"));
  EXPECT_THAT(text, HasSubstr("\nmax.defects.boundary_edges = 12345\n"));
  EXPECT_THAT(text, HasSubstr("\nmax.defects.zero_area = 0\n"));
  EXPECT_THAT(text, Not(HasSubstr("rendering_time")));
}

TEST(InitBudget, LimitsTimesWhereTheyWereMeasured) {
  analysis::AssetAnalysis asset = analysis_of({{"a", "a", 10, 0.1, 0}});
  set_time(asset, 1.00005, "discrete");
  const std::vector<AssetState> assets = {asset_of("a.glb", asset, analysis::MetricSet().set())};
  EXPECT_THAT(init_budget(assets), HasSubstr("\nmax.rendering_time_ms = 1.501\n"));
  EXPECT_FALSE(evaluate(parse_budget(init_budget(assets), "init"), assets, {}).failed);
}

TEST(InitBudget, NotesRatingsThatAreAtTheirEnd) {
  const std::string text = init_budget(std::vector{asset_of("a.glb", {{"a", "a", 10, 1, 0}})});
  EXPECT_THAT(text, HasSubstr("\n# max.polygons_per_planar_group = 1.0"));
}

}  // namespace
}  // namespace scene_analyzer::gate
