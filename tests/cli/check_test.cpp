// `check` as a user runs it: budgets, exit codes, baselines, every output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

class CheckTest : public testing::Test {
 protected:
  CheckTest() {
    folder_.write("cube.obj", cube_obj());
    folder_.write("leg.obj", leg_obj());
    folder_.write("bad.glb", "no glTF at all");
  }
  ProgramResult check(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "check");
    return run_program(arguments, {.environment = {}, .folder = folder_.path()});
  }
  // With a budget of one rule.
  ProgramResult check_rule(const std::string& lines, std::vector<std::string> arguments) const {
    folder_.write("budget.toml", "version = 1\n[[rule]]\nname = \"rule\"\n" + lines + "\n");
    arguments.insert(arguments.end(), {"--budget", "budget.toml"});
    return check(arguments);
  }
  std::string read(const std::string& name) const { return TemporaryFolder::read(folder_.path() / name); }
  int python(const std::string& script, const std::vector<std::string>& arguments) const {
    const std::string source = SCENE_ANALYZER_SOURCE_DIR;
    std::string command =
        "cd '" + folder_.path().string() + "' && /usr/bin/python3 '" + source + "/tests/" + script + "'";
    for (const std::string& argument : arguments) command += " '" + argument + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
};

TEST_F(CheckTest, PassesWhatIsWithinTheBudget) {
  const ProgramResult result =
      check_rule("max.triangles = 1000\nmax.file_bytes = \"1M\"", {"cube.obj", "leg.obj"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("gate passed: 1 of 1 rule pass\n"));
  EXPECT_THAT(complaints(result), IsEmpty());
}

TEST_F(CheckTest, FailsWhatIsBeyondIt) {
  const ProgramResult result = check_rule("max.triangles = 12", {"cube.obj", "leg.obj"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("error: rule: leg.obj: leg"), HasSubstr("limit max 12"),
                                HasSubstr("simplify the mesh"), Not(HasSubstr("cube.obj:"))));
  EXPECT_EQ(check_rule("severity = \"warning\"\nmax.triangles = 12", {"leg.obj"}).exit_code, 0);
}

TEST_F(CheckTest, SaysWhatIsUncheckedAndFailsItWhenStrict) {
  const std::string rule = "meshes = \"arm\"\nmax.triangles = 12";
  const ProgramResult result = check_rule(rule, {"leg.obj"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out,
              AllOf(StartsWith("verdict"), HasSubstr("unchecked  rule"), HasSubstr("applies to no mesh")));
  EXPECT_EQ(check_rule(rule, {"leg.obj", "--strict"}).exit_code, 1);
}

TEST_F(CheckTest, LeavesTimesOfACpuDeviceUncheckedAndUnmeasured) {
  const ProgramResult result = check_rule("max.rendering_time_ms = 0.0001", {"cube.obj", "--json", "-"});
  const json document = json::parse(result.out);
  if (document["rules"][0]["verdict"] == "fail") GTEST_SKIP() << "the device is no CPU device";
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(document["rules"][0]["verdict"], "unchecked");
  EXPECT_THAT(document["rules"][0]["reasons"][0]["reason"].get<std::string>(),
              HasSubstr("--allow-cpu-timing"));
  const ProgramResult allowed = check_rule(
      "max.rendering_time_ms = 0.0000001",
      {"cube.obj", "--allow-cpu-timing", "--steps", "1", "--timing-budget", "0.2", "--timing-size", "64x64"});
  EXPECT_EQ(allowed.exit_code, 1) << allowed.out;
}

TEST_F(CheckTest, MeasuresOnlyWhatIsLimited) {
  const ProgramResult result =
      check_rule("max.planar_group_variation = 1\nmax.triangles = 5", {"cube.obj", "--json", "-"});
  EXPECT_EQ(result.exit_code, 1);
  const ProgramResult analyzed = run_program({"analyze", "cube.obj", "--json", "-", "--metrics", "distance"},
                                             {.environment = {}, .folder = folder_.path()});
  EXPECT_EQ(analyzed.exit_code, 0);
  EXPECT_TRUE(json::parse(analyzed.out)["meshes"][0]["signal"].is_null())
      << "the analysis file has no signal";
}

TEST_F(CheckTest, GoesOnAfterABadAsset) {
  const ProgramResult within = check_rule("max.triangles = 1000", {"bad.glb", "cube.obj"});
  EXPECT_EQ(within.exit_code, 3);
  EXPECT_THAT(within.out,
              AllOf(HasSubstr("could not be analysed"), HasSubstr("1 asset could not be analysed")));
  const ProgramResult beyond = check_rule("max.triangles = 5", {"bad.glb", "cube.obj"});
  EXPECT_EQ(beyond.exit_code, 1) << "a failed gate wins";
  EXPECT_THAT(beyond.out, HasSubstr("cube.obj: cube"));
  EXPECT_EQ(check_rule("assets = \"cube*\"\nmax.triangles = 1000", {"bad.glb", "cube.obj"}).exit_code, 3);
}

TEST_F(CheckTest, RefusesWrongUse) {
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    const ProgramResult result = check(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  folder_.write("b.toml", "version = 1\n[[rule]]\nname = \"a\"\nmax.triangels = 1\n");
  EXPECT_THAT(refusal({}), HasSubstr("no asset is named"));
  EXPECT_THAT(refusal({"cube.obj"}), HasSubstr("--budget FILE"));
  EXPECT_THAT(refusal({"--budget", "b.toml"}), HasSubstr("no asset is named"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml"}),
              HasSubstr("b.toml:4:5: unknown limit 'max.triangels'"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "none.toml"}), HasSubstr("none.toml"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--init", "c.toml"}), HasSubstr("contradict"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--baseline", "none"}), HasSubstr("does not exist"));
  EXPECT_THAT(refusal({"cube.obj", "--init", "b.toml"}), HasSubstr("--force"));
  EXPECT_THAT(refusal({"cube.obj", "--init", "cube.obj", "--force"}), HasSubstr("would be overwritten"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--json", "-", "--github"}), HasSubstr("--github"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--json", "x", "--junit", "x"}),
              HasSubstr("the same file"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--sarif", "b.toml"}), HasSubstr("overwritten"));
  EXPECT_THAT(refusal({"cube.obj", "--budget", "b.toml", "--bugdet", "x"}),
              HasSubstr("did you mean --budget"));
}

TEST_F(CheckTest, InitWritesABudgetThatPasses) {
  const ProgramResult init = check({"cube.obj", "leg.obj", "--init", "first.toml"});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_EQ(init.out, "");
  const ProgramResult result = check({"cube.obj", "leg.obj", "--budget", "first.toml", "--strict"});
  EXPECT_EQ(result.exit_code, 0) << result.out << read("first.toml");
  EXPECT_THAT(result.out, HasSubstr("gate passed: 3 of 3 rules pass"));
  EXPECT_EQ(check({"cube.obj", "--init", "first.toml"}).exit_code, 2);
  EXPECT_EQ(check({"cube.obj", "--init", "first.toml", "--force"}).exit_code, 0);
  EXPECT_EQ(check({"cube.obj", "leg.obj", "--budget", "first.toml"}).exit_code, 1)
      << "the leg is beyond the cube's budget";
  EXPECT_EQ(check({"bad.glb", "--init", "none.toml"}).exit_code, 3);
  EXPECT_FALSE(fs::exists(folder_.path() / "none.toml"));
  EXPECT_EQ(check({"bad.glb", "cube.obj", "--init", "some.toml"}).exit_code, 3);
  EXPECT_TRUE(fs::exists(folder_.path() / "some.toml"));
}

TEST_F(CheckTest, ABaselineForgivesWhatWasThere) {
  const std::string rule = "max.triangles = 5";
  EXPECT_EQ(check_rule(rule, {"cube.obj"}).exit_code, 1);
  EXPECT_EQ(check_rule(rule, {"cube.obj", "--write-baseline", "base"}).exit_code, 0);
  EXPECT_EQ(check_rule(rule, {"cube.obj", "--baseline", "base"}).exit_code, 0);
  EXPECT_THAT(read("base/cube.obj.json"), Not(HasSubstr(folder_.path().string())));
  // A new asset, a worse one, a better one, a new mesh.
  EXPECT_EQ(check_rule(rule, {"cube.obj", "leg.obj", "--baseline", "base"}).exit_code, 1);
  folder_.write("cube.obj", obj_of(cli::prism(10, 1, 0.03, 0.12), "cube"));
  const ProgramResult worse = check_rule(rule, {"cube.obj", "--baseline", "base"});
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_THAT(worse.out, HasSubstr("the baseline has 12"));
  folder_.write("cube.obj", obj_of(cli::prism(3, 1, 0.03, 0.12), "cube"));
  EXPECT_EQ(check_rule(rule, {"cube.obj", "--baseline", "base"}).exit_code, 0);
  folder_.write("cube.obj", obj_of(cli::prism(3, 1, 0.03, 0.12), "another"));
  EXPECT_EQ(check_rule(rule, {"cube.obj", "--baseline", "base"}).exit_code, 1);
}

TEST_F(CheckTest, ABaselineCanBeMovedButNotMixed) {
  const std::string rule = "max.triangles = 5";
  check_rule(rule, {"cube.obj", "--write-baseline", "base"});
  fs::create_directory(folder_.path() / "elsewhere");
  for (const char* name : {"cube.obj", "base", "budget.toml"})
    fs::copy(folder_.path() / name, folder_.path() / "elsewhere" / name, fs::copy_options::recursive);
  const ProgramResult moved = run_program({"check", (folder_.path() / "elsewhere/cube.obj").string(),
                                           "--budget", "budget.toml", "--baseline", "base"},
                                          {.environment = {}, .folder = folder_.path() / "elsewhere"});
  EXPECT_EQ(moved.exit_code, 0) << moved.out << moved.err;
  const ProgramResult mixed = check_rule(rule, {"cube.obj", "--baseline", "base", "--alpha", "2"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("--alpha 0"));
  fs::create_directory(folder_.path() / "empty");
  EXPECT_THAT(check_rule(rule, {"cube.obj", "--baseline", "empty"}).err,
              HasSubstr("empty has none of the assets"));
}

TEST_F(CheckTest, WritesEveryFormat) {
  const ProgramResult result =
      check_rule("max.triangles = 5", {"bad.glb", "cube.obj", "leg.obj", "--json", "c.json", "--junit",
                                       "c.xml", "--sarif", "c.sarif", "--github"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(python("report/validate_report.py",
                   {std::string(SCENE_ANALYZER_SOURCE_DIR) + "/docs/schema/check-v1.schema.json", "c.json"}),
            0);
  EXPECT_EQ(python("gate/check_junit.py", {"c.xml"}), 0);
  EXPECT_EQ(python("gate/check_sarif.py", {"c.sarif"}), 0);
  EXPECT_EQ(json::parse(read("c.json"))["counts"]["errors"], 2);
  EXPECT_THAT(lines_with(result.out, "::error file="), SizeIs(3));
  EXPECT_THAT(lines_with(result.out, "::notice title=scene-analyzer check::gate failed: "), SizeIs(1));
  EXPECT_THAT(result.out, StartsWith("::stop-commands::scene-analyzer-"));
  const std::string word = result.out.substr(17, result.out.find('\n') - 17);
  EXPECT_THAT(result.out, HasSubstr("\n::" + word + "::\n::error "));
  for (const char* option : {"--json", "--junit", "--sarif"})
    EXPECT_THAT(check_rule("max.triangles = 5000", {"cube.obj", option, "-"}).out,
                Not(HasSubstr("gate passed")));
}

TEST_F(CheckTest, TellsOfAFileThatCannotBeWritten) {
  const ProgramResult result = check_rule("max.triangles = 5000", {"cube.obj", "--json", "/dev/full"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("gate passed")) << "the others are written";
  EXPECT_EQ(check_rule("max.triangles = 5", {"cube.obj", "--json", "/dev/full"}).exit_code, 1);
}

TEST_F(CheckTest, NamesOfMeshesCannotForgeCommands) {
  std::string asset = gltf_triangle("t.bin");
  asset.replace(asset.find("\"name\":\"node\""), 13,
                "\"name\":\"x\\n::error file=a,title=b::forged\\u001b[31m\"");
  folder_.write("t.gltf", asset);
  folder_.write("t.bin", std::string(36, '\0'));
  const ProgramResult result = check_rule("max.defects.total = 0", {"t.gltf", "--github"});
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_THAT(lines_with(result.out, "::error file=a"), IsEmpty());
  EXPECT_THAT(result.out, Not(HasSubstr("\x1b")));
}

TEST_F(CheckTest, TakesFoldersOfAssets) {
  fs::create_directories(folder_.path() / "library/sub");
  fs::create_directories(folder_.path() / "empty");
  folder_.write("library/cube.obj", cube_obj());
  folder_.write("library/sub/leg.obj", leg_obj());
  const json document =
      json::parse(check_rule("max.triangles = 5", {"library/", "cube.obj", "--json", "-"}).out);
  EXPECT_EQ(document["counts"]["assets"], 3);
  EXPECT_EQ(document["findings"][0]["asset"], "library/sub/leg.obj");
  EXPECT_EQ(check_rule("max.triangles = 5", {"empty"}).exit_code, 2);
}

TEST_F(CheckTest, AnAssetGivenTwiceIsCheckedOnce) {
  const ProgramResult result = check_rule("max.triangles = 5", {"cube.obj", "./cube.obj", "--json", "-"});
  EXPECT_EQ(json::parse(result.out)["counts"]["assets"], 1);
}

TEST_F(CheckTest, CountsReferencedFilesAlsoWithoutAnalysisFiles) {
  folder_.write("t.gltf", gltf_triangle("t.bin"));
  folder_.write("t.bin", std::string(36, '\0'));
  const auto bytes = fs::file_size(folder_.path() / "t.gltf") + 36;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--no-cache"}, std::vector<std::string>{}}) {
    std::vector<std::string> arguments = {"t.gltf", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(json::parse(check_rule("max.file_bytes = 1", arguments).out)["findings"][0]["value"], bytes);
  }
}

}  // namespace
}  // namespace scene_analyzer
