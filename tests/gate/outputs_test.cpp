#include "gate/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "gate/gate_fixture.h"
#include "report/terminal_text.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::gate {
namespace {

using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Line breaks, an escape sequence, workflow commands, markup, a direction override, bytes that are no UTF-8.
constexpr const char* kHostile =
    "a\n::error::b\r\n##[group]%0A,c:d<x y=\"1\">&amp;]]>\x1b[31m\xE2\x80\xAE\xFF\xEF\xBF\xBE\xEF\xBF\xBF'z";

constexpr const char* kBudget = R"(version = 1
[[rule]]
name = "sizes, all: <&\"'> 100%"
max.triangles = 50
max.defects.total = 0
[[rule]]
name = "soft"
severity = "warning"
max.polygons_per_planar_group = 0.5
[[rule]]
name = "nothing"
meshes = "none"
max.triangles = 1
[[rule]]
name = "good"
assets = "good*"
max.file_bytes = "1K"
)";

struct Made {
  Budget budget = parse_budget(kBudget, "dir/budget <1>.toml");
  std::vector<AssetState> assets;
  CheckResult result;
  bool strict = false;

  CheckReport report() const {
    return {.budget = budget, .assets = assets, .result = result, .baseline = "", .strict = strict};
  }
};

Made make(std::uint32_t meshes = 2, bool strict = false) {
  Made made;
  made.strict = strict;
  std::vector<TestMesh> rows;
  for (std::uint32_t i = 0; i < meshes; ++i)
    rows.push_back({i == 0 ? kHostile : "", kHostile, 100 + i, 0.75, i});
  analysis::AssetAnalysis analysis = analysis_of(rows);
  analysis.geometries[0].defects->found = {{analysis::Defect::kBoundaryEdges, 3, {0}}};
  made.assets.push_back(asset_of(std::string("f\xC3\xBCr uns/") + kHostile, analysis));
  made.assets.push_back(asset_of("good.glb", {{"n", "m", 3, 0.1, 0}}));
  made.assets.push_back(failed_asset(kHostile, std::string("broken: ") + kHostile));
  made.result = evaluate(made.budget, made.assets, {.strict = strict});
  return made;
}

// Exit code of a Python program of this repository's tests.
int python(const std::string& script, const std::vector<std::string>& arguments) {
  std::string command =
      "/usr/bin/python3 '" + std::string(SCENE_ANALYZER_SOURCE_DIR) + "/tests/" + script + "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CheckTable, SaysVerdictsFindingsAndWhatToDo) {
  const Made made = make();
  const std::string table = check_table(made.report(), {});
  EXPECT_THAT(table, HasSubstr("FAIL"));
  EXPECT_THAT(table, HasSubstr("defects.total 3, limit max 0"));
  EXPECT_THAT(table, HasSubstr("triangles 101, limit max 50 (2.02 times): simplify the mesh"));
  EXPECT_THAT(table, HasSubstr("merge coplanar triangles"));
  EXPECT_THAT(table, HasSubstr("nothing: it applies to no mesh"));
  EXPECT_THAT(table, HasSubstr("\ncould not be analysed:\n  a"));
  EXPECT_THAT(
      table,
      EndsWith("\ngate failed: 1 of 4 rules pass, 2 fail (3 errors, 2 warnings), 1 unchecked; 1 asset could "
               "not be analysed\n"));
}

TEST(CheckTable, ShowsNamesWithoutTheirControls) {
  const std::string table = check_table(make().report(), {});
  EXPECT_EQ(report::valid_utf8(table), table);
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
  EXPECT_EQ(table.find('\r'), std::string::npos);
  EXPECT_THAT(table, Not(HasSubstr("\n::error")));
  EXPECT_THAT(table, Not(HasSubstr("\xE2\x80\xAE")));
}

TEST(CheckTable, FitsTheTerminalAndCapsItsRows) {
  const Made made = make(200);
  const std::string table = check_table(made.report(), {.color = false, .width = 80, .max_rows = 0});
  EXPECT_THAT(table, HasSubstr("  ... and 351 more findings\n"));
  const report::UnicodeScope unicode;
  std::istringstream lines(table.substr(table.find("findings, ")));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    EXPECT_LE(report::columns(report::printable(line)), 80U) << line;
}

TEST(CheckJson, FollowsItsSchema) {
  const TemporaryFolder folder;
  const std::string schema = std::string(SCENE_ANALYZER_SOURCE_DIR) + "/docs/schema/check-v1.schema.json";
  const auto faults = [&](const Made& made) {
    return python("report/validate_report.py",
                  {schema, folder.write("c.json", check_json(made.report())).string()});
  };
  EXPECT_EQ(faults(make()), 0);
  EXPECT_EQ(faults(make(1200, true)), 0);
  json broken = json::parse(check_json(make().report()));
  broken["counts"].erase("errors");
  EXPECT_EQ(python("report/validate_report.py", {schema, folder.write("b.json", broken.dump()).string()}), 1);
}

TEST(CheckJson, SchemaKnowsAllQuantities) {
  const json schema = json::parse(
      TemporaryFolder::read(std::string(SCENE_ANALYZER_SOURCE_DIR) + "/docs/schema/check-v1.schema.json"));
  const auto keys = quantity_keys();
  EXPECT_EQ(schema["properties"]["findings"]["items"]["properties"]["quantity"]["enum"],
            json(std::vector<std::string>(keys.begin(), keys.end())));
}

TEST(CheckJson, CountsEverythingAndListsTheWorst) {
  const json document = json::parse(check_json(make(1200).report()));
  EXPECT_EQ(document["verdict"], "fail");
  EXPECT_EQ(document["counts"]["errors"], 1201);
  EXPECT_EQ(document["counts"]["warnings"], 1200);
  EXPECT_EQ(document["findings"].size(), kMostFindings);
  EXPECT_EQ(document["findings"][0]["quantity"], "defects.total");
  EXPECT_TRUE(document["findings"][0]["ratio"].is_null());
  EXPECT_EQ(document["findings"][1]["value"], 1299);
  EXPECT_EQ(document["findings"][1]["index"], 1199);
  EXPECT_EQ(document["rules"][2]["verdict"], "unchecked");
  EXPECT_EQ(document["assets_not_analysed"].size(), 1U);
}

TEST(CheckJunit, FollowsTheRulesOfJUnit) {
  const TemporaryFolder folder;
  for (const bool strict : {false, true})
    EXPECT_EQ(python("gate/check_junit.py",
                     {folder.write("j.xml", check_junit(make(3, strict).report())).string()}),
              0);
  std::string broken = check_junit(make().report());
  broken.replace(broken.find("failures=\"1\""), 12, "failures=\"2\"");
  EXPECT_EQ(python("gate/check_junit.py", {folder.write("b.xml", broken).string()}), 1)
      << "the check notices";
}

TEST(CheckJunit, HasACasePerRuleAndPerFailedAsset) {
  const std::string xml = check_junit(make().report());
  EXPECT_THAT(xml, HasSubstr("tests=\"5\" failures=\"1\" errors=\"1\" skipped=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"3 findings\" type=\"beyond-limit\">"));
  EXPECT_THAT(xml, HasSubstr("<system-out>warning: 2 findings"));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"scene-analyzer.rules\" name=\"good\"/>"));
  EXPECT_THAT(check_junit(make(2, true).report()), HasSubstr("type=\"unchecked\""));
}

TEST(CheckSarif, FollowsTheRulesOfSarif) {
  const TemporaryFolder folder;
  for (const std::uint32_t meshes : {2U, 1200U})
    EXPECT_EQ(python("gate/check_sarif.py",
                     {folder.write("s.sarif", check_sarif(make(meshes, true).report())).string()}),
              0);
  json broken = json::parse(check_sarif(make().report()));
  broken["runs"][0]["results"][0]["ruleIndex"] = 7;
  EXPECT_EQ(python("gate/check_sarif.py", {folder.write("b.sarif", broken.dump()).string()}), 1)
      << "the check notices";
}

TEST(CheckSarif, EncodesPathsAndTellsFindingsApart) {
  const json run = json::parse(check_sarif(make(3).report()))["runs"][0];
  const json& results = run["results"];
  ASSERT_EQ(results.size(), 7U);
  const std::string uri = results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
  EXPECT_THAT(uri, StartsWith("f%C3%BCr%20uns/a%0A%3A%3Aerror%3A%3Ab%0D%0A%23%23%5Bgroup%5D%250A%2Cc"));
  EXPECT_EQ(results[0]["level"], "error");
  EXPECT_EQ(results[6]["level"], "warning");
  EXPECT_NE(results[0]["partialFingerprints"], results[1]["partialFingerprints"]);
  EXPECT_FALSE(run["invocations"][0]["executionSuccessful"]);
}

TEST(GitHubAnnotations, AreTheTenWorstAndACountOfTheRest) {
  const std::string text = github_annotations(make(30).report());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 13)
      << "ten findings, one asset, one unchecked rule, the rest";
  EXPECT_THAT(text, StartsWith("::error file=f\xC3\xBCr uns/a"));
  EXPECT_THAT(text, HasSubstr("title=sizes%2C all%3A <&\"'>"));
  EXPECT_THAT(text, HasSubstr("100%25::"));
  EXPECT_THAT(text, HasSubstr("::warning title=nothing::not checked: "));
  EXPECT_THAT(github_annotations(make(30, true).report()), HasSubstr("::error title=nothing::not checked: "));
  EXPECT_THAT(text, HasSubstr("51 findings are not shown\n"));
  EXPECT_THAT(text, HasSubstr("title=could not be analysed::broken: a"));
}

TEST(GitHubAnnotations, CannotBeForgedByNames) {
  std::istringstream lines(github_annotations(make().report()));
  for (std::string line; std::getline(lines, line);) {
    const bool is_ours = line.starts_with("::error file=") || line.starts_with("::warning file=") ||
                         line.starts_with("::warning title=") || line.starts_with("::notice title=");
    EXPECT_TRUE(is_ours) << line;
    const std::string properties = line.substr(2, line.find("::", 2) - 2);
    EXPECT_EQ(properties.find_first_of(":\r\x1b"), std::string::npos) << properties;
    EXPECT_LE(std::count(properties.begin(), properties.end(), ','), 1) << properties;
  }
}

TEST(GitHubAnnotations, OfAPassAreOneNotice) {
  Made made;
  made.budget = one_rule("max.triangles = 50");
  made.assets = {asset_of("good.glb", {{"n", "m", 3, 0.1, 0}})};
  made.result = evaluate(made.budget, made.assets, {});
  EXPECT_EQ(github_annotations(made.report()),
            "::notice title=scene-analyzer check::gate passed: 1 of 1 rule pass\n");
}

}  // namespace
}  // namespace scene_analyzer::gate
