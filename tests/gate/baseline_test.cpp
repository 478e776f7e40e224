#include "gate/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "gate/baseline_file.h"
#include "gate/evaluate.h"
#include "gate/gate_fixture.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::gate {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

AssetBaseline baseline(const AssetState& asset) {
  return baseline_of(asset, kDefaultWeights, std::nullopt);
}

CheckResult check(const std::string& lines, const AssetState& now, const AssetState& before) {
  const Baselines baselines = {{before.path, baseline(before)}};
  return evaluate(one_rule(lines), std::span(&now, 1), {.baselines = &baselines});
}

AssetState table(std::uint64_t triangles, double pppg = 0.2) {
  return asset_of("t.glb", {{"Top", "top", triangles, pppg, 0}});
}

TEST(Baseline, FailsOnlyWhatGotWorse) {
  EXPECT_EQ(check("max.triangles = 50", table(120), table(120)).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check("max.triangles = 50", table(120), table(120)).tolerated, 1U);
  EXPECT_EQ(check("max.triangles = 50", table(100), table(120)).rules[0].verdict, Verdict::kPass);
  const CheckResult worse = check("max.triangles = 50", table(121), table(120));
  EXPECT_EQ(worse.rules[0].verdict, Verdict::kFail);
  EXPECT_EQ(worse.worst.at(0).baseline, 120);
  EXPECT_EQ(check("max.triangles = 500", table(121), table(120)).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check("min.triangles = 500", table(119), table(120)).rules[0].verdict, Verdict::kFail);
  EXPECT_EQ(check("min.triangles = 500", table(121), table(120)).rules[0].verdict, Verdict::kPass);
}

TEST(Baseline, ForgivesTheLastDigitsOfRatings) {
  const std::string rule = "max.polygons_per_planar_group = 0.5";
  EXPECT_EQ(check(rule, table(10, 0.600005), table(10, 0.6)).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check(rule, table(10, 0.60002), table(10, 0.6)).rules[0].verdict, Verdict::kFail);
}

TEST(Baseline, SaysNothingAboutWhatIsNew) {
  const AssetState now = asset_of("t.glb", {{"Top", "top", 120, 0.2, 0}, {"Leg", "leg", 120, 0.2, 1}});
  const CheckResult result = check("max.triangles = 50", now, table(120));
  ASSERT_EQ(result.worst.size(), 1U);
  EXPECT_EQ(result.worst[0].node, "Leg");
  EXPECT_FALSE(result.worst[0].baseline);
  AssetState other = table(120);
  other.path = "other.glb";
  EXPECT_EQ(check("max.triangles = 50", now, other).new_assets, 1U);
  EXPECT_EQ(check("max.triangles = 50", now, other).errors, 2U);
}

TEST(Baseline, KnowsMeshesByNameAndOccurrenceNotByRow) {
  const AssetState before =
      asset_of("t.glb", {{"A", "a", 60, 0.2, 0}, {"B", "b", 70, 0.2, 1}, {"B", "b", 80, 0.2, 2}});
  const AssetState now =
      asset_of("t.glb", {{"B", "b", 70, 0.2, 0}, {"B", "b", 80, 0.2, 1}, {"A", "a", 60, 0.2, 2}});
  EXPECT_EQ(check("max.triangles = 50", now, before).tolerated, 3U);
  const AssetState swapped =
      asset_of("t.glb", {{"B", "b", 80, 0.2, 0}, {"B", "b", 70, 0.2, 1}, {"A", "a", 60, 0.2, 2}});
  EXPECT_EQ(check("max.triangles = 50", swapped, before).errors, 1U);
}

TEST(Baseline, ComparesTimesOfTheSameDeviceOnly) {
  const auto timed = [](double milliseconds, const std::string& device) {
    analysis::AssetAnalysis asset = analysis_of({{"Top", "top", 40, 0.2, 0}});
    set_time(asset, milliseconds, "discrete", device);
    return asset_of("t.glb", asset, analysis::MetricSet().set());
  };
  const std::string rule = "max.rendering_time_ms = 1";
  EXPECT_EQ(check(rule, timed(2, "B"), timed(2, "A")).rules[0].verdict, Verdict::kUnchecked);
  EXPECT_EQ(check(rule, timed(0.5, "B"), timed(2, "A")).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check(rule, timed(2.09, "A"), timed(2, "A")).rules[0].verdict, Verdict::kPass);
  EXPECT_EQ(check(rule, timed(2.11, "A"), timed(2, "A")).rules[0].verdict, Verdict::kFail);
}

TEST(BaselineFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  analysis::AssetAnalysis analysis = analysis_of({{"T\xFFop", "to\"p", 40, 0.2, 0}, {"", "", 4, 0, 1}});
  set_time(analysis, 2, "discrete");
  analysis.parameters.alpha_degrees = 2.5;
  const AssetBaseline written =
      baseline_of(asset_of("../props/t.glb", analysis), {1, 0, 0, 2, 0, 0, 0}, mesh::Vector3{1, 2.5, 3});
  write_baseline(folder.path(), written);
  const auto read = read_baseline(folder.path(), "../props/t.glb");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->asset, written.asset);
  EXPECT_EQ(read->parameters, written.parameters);
  EXPECT_EQ(read->weights, written.weights);
  EXPECT_EQ(read->eye, written.eye);
  EXPECT_TRUE(same_conditions(read->timing, written.timing));
  EXPECT_EQ(read->values, written.values);
  ASSERT_EQ(read->meshes.size(), 2U);
  EXPECT_EQ(read->meshes[0].values, written.meshes[0].values);
  EXPECT_EQ(read->meshes[0].node, written.meshes[0].node);
  EXPECT_EQ(match_meshes(asset_of("../props/t.glb", analysis), *read)[0], 0U)
      << "names that are no UTF-8, too";
  EXPECT_NO_THROW(require_comparable(*read, written));
  EXPECT_FALSE(read_baseline(folder.path(), "other.glb"));
}

TEST(BaselineFile, TellsNothingOfTheMachine) {
  const TemporaryFolder folder;
  write_baseline(folder.path(), baseline(asset_of("props/t.glb", analysis_of({{"Top", "top", 40, 0.2, 0}}))));
  const std::string text = TemporaryFolder::read(folder.path() / "props/t.glb.json");
  EXPECT_THAT(text, HasSubstr("\"asset\": \"props/t.glb\""));
  EXPECT_EQ(text.find(folder.path().string()), std::string::npos);
}

TEST(BaselineFile, ThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  write_baseline(folder.path(), baseline(table(10)));
  const std::string good = TemporaryFolder::read(folder.path() / "t.glb.json");
  fs::rename(folder.path() / "t.glb.json", folder.path() / "other.glb.json");
  EXPECT_THROW(read_baseline(folder.path(), "other.glb"), UsageError) << "of another asset";
  for (std::size_t length = 0; length + 2 < good.size(); length += 7) {
    folder.write("t.glb.json", good.substr(0, length));
    EXPECT_THROW(read_baseline(folder.path(), "t.glb"), UsageError);
  }
  for (const char* text :
       {"[]", "1", "{\"scene_analyzer_baseline\":2}", "{\"scene_analyzer_baseline\":\"1\"}"}) {
    folder.write("t.glb.json", text);
    EXPECT_THROW(read_baseline(folder.path(), "t.glb"), UsageError) << text;
  }
  fs::remove(folder.path() / "t.glb.json");
  fs::create_directory(folder.path() / "t.glb.json");
  EXPECT_THROW(read_baseline(folder.path(), "t.glb"), UsageError);
}

TEST(BaselineFile, OfOtherOptionsIsRefused) {
  const AssetBaseline before = baseline(table(10));
  AssetBaseline now = before;
  now.parameters.alpha_degrees = 2;
  EXPECT_THROW(require_comparable(before, now), UsageError);
  now = before;
  now.weights[0] = 3;
  EXPECT_THROW(require_comparable(before, now), UsageError);
  now = before;
  now.eye = mesh::Vector3{1, 2, 3};
  EXPECT_THROW(require_comparable(before, now), UsageError);
}

TEST(BaselinePlace, IsAnotherOneForEveryAssetAndNeverOutside) {
  std::set<fs::path> places;
  const std::vector<std::string> assets = {"a.glb",
                                           "a.glb.json/b",
                                           "a.glb.json~/b",
                                           "../a.glb",
                                           "~up/a.glb",
                                           "~~up/a.glb",
                                           "../../a.glb",
                                           "a/b.glb",
                                           std::string(255, 'x'),
                                           std::string(254, 'x') + "y",
                                           std::string(255, 'x') + "/a"};
  for (const std::string& asset : assets) {
    const fs::path place = baseline_place("base", asset);
    places.insert(place);
    EXPECT_EQ(place.lexically_normal(), place);
    EXPECT_EQ(*place.begin(), "base");
    for (const fs::path& part : place) EXPECT_LE(part.string().size(), 255U);
  }
  EXPECT_EQ(places.size(), assets.size());
  EXPECT_FALSE(places.contains("base/a.glb.json/b.json")) << "that of a.glb is a file of this name";
}

}  // namespace
}  // namespace scene_analyzer::gate
