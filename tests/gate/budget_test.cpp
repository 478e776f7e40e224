#include "gate/budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "gate/gate_fixture.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::gate {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAre;

std::string refusal(const std::string& text) {
  try {
    parse_budget(text, "b.toml");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was refused";
}

std::string rule_refusal(const std::string& line) {
  return refusal("version = 1\n[[rule]]\nname = \"a\"\n" + line);
}

TEST(BudgetFile, HoldsWhatItSays) {
  const Budget budget = parse_budget(R"(version = 1
eye = [0, 1.7, -2]
[weights]
distance = 2
relative_density = 0.5

[[rule]]
name = "props"
assets = "props/*"
meshes = ["*_lod0", "Leg?"]
severity = "warning"
max.triangles = 5000
max.defects.total = 0
max.defects.boundary_edges = 12
min.relative_density = -0.5

[[rule]]
name = "all"
max = { file_bytes = "1.5M", rendering_time_ms = 2 }
)",
                                     "b.toml");
  EXPECT_EQ(budget.file, "b.toml");
  EXPECT_EQ(budget.eye, (mesh::Vector3{0, 1.7, -2}));
  EXPECT_EQ(budget.weights, (Weights{0, 0, 0.5, 2, 0, 0, 0}));
  ASSERT_EQ(budget.rules.size(), 2U);
  const Rule& props = budget.rules[0];
  EXPECT_EQ(props.name, "props");
  EXPECT_EQ(props.line, 7U);
  EXPECT_EQ(props.severity, Severity::kWarning);
  EXPECT_THAT(props.assets, ElementsAre("props/*"));
  EXPECT_THAT(props.meshes, ElementsAre("*_lod0", "Leg?"));
  EXPECT_THAT(props.limits,
              UnorderedElementsAre(Limit{Quantity::kTriangles, Bound::kMost, 5000},
                                   Limit{Quantity::kDefectTotal, Bound::kMost, 0},
                                   Limit{*quantity_of("defects.boundary_edges"), Bound::kMost, 12},
                                   Limit{*quantity_of("relative_density"), Bound::kLeast, -0.5}));
  EXPECT_EQ(budget.rules[1].severity, Severity::kError);
  EXPECT_THAT(budget.rules[1].limits,
              UnorderedElementsAre(Limit{Quantity::kFileBytes, Bound::kMost, 1.5 * 1024 * 1024},
                                   Limit{Quantity::kRenderingTime, Bound::kMost, 2}));
}

TEST(BudgetFile, IsRefusedWithThePlaceAndTheRemedy) {
  EXPECT_THAT(
      rule_refusal("max.triangels = 3"),
      AllOf(StartsWith("b.toml:4:5: "), HasSubstr("'max.triangels'"), HasSubstr("did you mean triangles?")));
  EXPECT_THAT(rule_refusal("max.defects.duplicates = 3"),
              HasSubstr("unknown limit 'max.defects.duplicates'"));
  EXPECT_THAT(rule_refusal("  sevrity = \"error\""),
              AllOf(StartsWith("b.toml:4:3: "), HasSubstr("did you mean severity?")));
  EXPECT_THAT(rule_refusal("severity = \"eror\"\nmax.triangles = 1"),
              AllOf(StartsWith("b.toml:4:12: "), HasSubstr("did you mean error?")));
  EXPECT_THAT(refusal("versoin = 1"), AllOf(StartsWith("b.toml:1:1: "), HasSubstr("did you mean version?")));
  EXPECT_THAT(refusal("version = 1\nweights.distanc = 1"),
              AllOf(StartsWith("b.toml:2:9: "), HasSubstr("did you mean distance?")));
  EXPECT_THAT(refusal("version = 1\n[[rule]\nname = 1"),
              AllOf(StartsWith("b.toml:2:"), HasSubstr("is no TOML")));
}

TEST(BudgetFile, NeedsAVersionThatIsKnown) {
  EXPECT_THAT(refusal(""), HasSubstr("write version = 1"));
  EXPECT_THAT(refusal("version = 2"),
              AllOf(StartsWith("b.toml:1:11: "), HasSubstr("a newer scene-analyzer")));
  EXPECT_THAT(refusal("version = \"1\""), HasSubstr("has to be the whole number 1"));
}

TEST(BudgetFile, NeedsRulesWithNamesAndLimits) {
  EXPECT_THAT(refusal("version = 1"), HasSubstr("write [[rule]]"));
  EXPECT_THAT(refusal("version = 1\nrule = []"), HasSubstr("[[rule]]"));
  EXPECT_THAT(refusal("version = 1\n[rule]\nname = \"a\""),
              AllOf(StartsWith("b.toml:2:1: "), HasSubstr("two brackets")));
  EXPECT_THAT(refusal("version = 1\n[[rule]]\nmax.triangles = 1"),
              AllOf(StartsWith("b.toml:2:1: "), HasSubstr("without a name")));
  EXPECT_THAT(rule_refusal(""), HasSubstr("rule 'a' has no limit"));
  EXPECT_THAT(rule_refusal("max.triangles = 1\n[[rule]]\nname = \"a\"\nmax.triangles = 1"),
              AllOf(StartsWith("b.toml:6:8: "), HasSubstr("another rule named 'a'")));
  EXPECT_THAT(refusal("version = 1\n[[rule]]\nname = \"\"\nmax.triangles = 1"), HasSubstr("1 to 1000 bytes"));
  EXPECT_THAT(refusal("version = 1\n[[rule]]\nname = \"a\\u0000b\"\nmax.triangles = 1"),
              HasSubstr("\\u0000"));
  EXPECT_THAT(refusal("version = 1\n[[rule]]\nname = \"a\\nb\"\nmax.triangles = 1"),
              HasSubstr("control characters"));
}

TEST(BudgetFile, RefusesLimitsThatNothingCanMeetOrMiss) {
  EXPECT_THAT(rule_refusal("max.aggregate = 1.5"),
              AllOf(StartsWith("b.toml:4:17: "), HasSubstr("lie in [0, 1]")));
  EXPECT_THAT(rule_refusal("max.triangles = -1"), HasSubstr("lie in [0, "));
  EXPECT_THAT(rule_refusal("max.triangles = 1.5"), HasSubstr("a whole number"));
  EXPECT_THAT(rule_refusal("min.relative_density = -1.1"), HasSubstr("lie in [-1, 1]"));
  EXPECT_THAT(rule_refusal("max.distance = nan"), HasSubstr("a finite number"));
  EXPECT_THAT(rule_refusal("max.rendering_time_ms = inf"), HasSubstr("a finite number"));
  EXPECT_THAT(rule_refusal("max.triangles = 9223372036854775807"), HasSubstr("lie in"));
  EXPECT_THAT(rule_refusal("max.triangles = 5\nmin.triangles = 6"), HasSubstr("nothing can pass"));
  EXPECT_THAT(rule_refusal("max.defects.total = 1\nmax.\"defects.total\" = 2"), HasSubstr("limited twice"));
}

TEST(BudgetFile, RefusesOtherTypes) {
  EXPECT_THAT(rule_refusal("max.triangles = \"5\""), HasSubstr("has to be a number"));
  EXPECT_THAT(rule_refusal("max.triangles = 2026-01-31"), HasSubstr("has to be a number"));
  EXPECT_THAT(rule_refusal("max = 5"), HasSubstr("max.triangles = 5000"));
  EXPECT_THAT(rule_refusal("max.defects = 5"), HasSubstr("max.defects.total = 0"));
  EXPECT_THAT(rule_refusal("max.file_bytes = \"5 M\""), HasSubstr("a size such as"));
  EXPECT_THAT(rule_refusal("assets = 5\nmax.triangles = 1"), HasSubstr("a glob such as"));
  EXPECT_THAT(rule_refusal("assets = []\nmax.triangles = 1"), HasSubstr("1 to 100 globs"));
  EXPECT_THAT(rule_refusal("meshes = [\"a\", 1]\nmax.triangles = 1"), HasSubstr("a text in quotes"));
  EXPECT_THAT(refusal("version = 1\neye = [1, 2]"), HasSubstr("three numbers"));
  EXPECT_THAT(refusal("version = 1\nweights = 1"), HasSubstr("a table"));
  EXPECT_THAT(refusal("version = 1\nweights.distance = -1"), HasSubstr("[0, 1e6]"));
  EXPECT_THAT(refusal("version = 1\nweights.distance = 0"), HasSubstr("no metric has a weight above 0"));
}

TEST(BudgetFile, WithstandsHostileBytes) {
  EXPECT_THAT(refusal(std::string(kMostBudgetBytes + 1, '#')), HasSubstr("is larger than 1 MiB"));
  std::string keys = "version = 1\n";
  for (int i = 0; i < 100'000; ++i) keys += "a.";
  EXPECT_THAT(refusal(keys + "a = 1"), AllOf(StartsWith("b.toml:2:1: "), HasSubstr("dots")));
  EXPECT_THAT(refusal("version = 1\na = " + std::string(100'000, '[')),
              AllOf(StartsWith("b.toml:2:"), HasSubstr("no TOML")));
  EXPECT_THAT(refusal("version = 1\na = \"\xFF\xFE\""), HasSubstr("is no TOML"));
  std::string rules = "version = 1\n";
  for (std::size_t i = 0; i <= kMostRules; ++i) rules += "[[rule]]\n";
  EXPECT_THAT(refusal(rules), HasSubstr("more than 1000 rules"));
  EXPECT_THAT(rule_refusal("max." + std::string(10'000, 'x') + " = 1"), testing::SizeIs(testing::Lt(2000U)));
}

TEST(BudgetFile, ThatCannotBeReadIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_budget(folder.path()), UsageError);
  EXPECT_THROW(read_budget(folder.path() / "none.toml"), UsageError);
  folder.write("b.toml", "version = 1\n[[rule]]\nname = \"a\"\nmax.triangles = 1\n");
  EXPECT_EQ(read_budget(folder.path() / "b.toml").rules.size(), 1U);
}

TEST(Budget, NeedsOnlyTheMetricsThatItLimits) {
  const auto keys = [](const std::string& lines) { return needed_metrics(one_rule(lines)).to_string(); };
  EXPECT_EQ(keys("max.triangles = 1\nmax.defects.total = 0\nmax.file_bytes = 1"), "0000000");
  EXPECT_EQ(keys("max.distance = 0.5"), "0001000");
  EXPECT_EQ(keys("max.rendering_time_ms = 5"), "1000000");
  EXPECT_EQ(keys("max.aggregate = 0.5"), "0111111");
  EXPECT_EQ(needed_metrics(parse_budget("version = 1\nweights.rendering_time = 1\nweights.distance = 1\n"
                                        "[[rule]]\nname = \"a\"\nmax.aggregate = 0.5",
                                        "b"))
                .to_string(),
            "1001000");
}

TEST(Budget, GlobsOfAssetsLookAtTheFileNameUnlessTheyHaveFolders) {
  const auto applies = [](const std::string& glob, const std::string& path) {
    return applies_to_asset({.name = "a", .assets = {glob}}, path);
  };
  EXPECT_TRUE(applies("chair.glb", "props/chair.glb"));
  EXPECT_FALSE(applies("prop*", "props/chair.glb"));
  EXPECT_TRUE(applies("props/*", "props/old/chair.glb"));
  EXPECT_FALSE(applies("old/*", "props/old/chair.glb"));
  EXPECT_TRUE(applies_to_asset({.name = "a"}, "anything"));
  EXPECT_TRUE(applies_to_mesh({.name = "a", .meshes = {"x", "Leg*"}}, "Leg 1", "mesh"));
  EXPECT_TRUE(applies_to_mesh({.name = "a", .meshes = {"mesh"}}, "Leg 1", "mesh"));
  EXPECT_FALSE(applies_to_mesh({.name = "a", .meshes = {"leg*"}}, "Leg 1", "mesh"));
}

}  // namespace
}  // namespace scene_analyzer::gate
