// `scene-analyzer analyze` as a user runs it: outputs, analysis files, devices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::map<std::string, std::string> kNoDriver = {{"VK_DRIVER_FILES", "/nonexistent"},
                                                      {"VK_ICD_FILENAMES", "/nonexistent"}};

bool follows_schema(const fs::path& report) {
  const std::string source = SCENE_ANALYZER_SOURCE_DIR;
  const std::string command = fmt::format(
      "/usr/bin/python3 '{0}/tests/report/validate_report.py' '{0}/docs/schema/report-v1.schema.json' '{1}'",
      source, report.string());
  return std::system(command.c_str()) == 0;
}

class AnalyzeTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments, ProgramOptions options = {}) {
    arguments.insert(arguments.begin(), "analyze");
    options.folder = folder_.path();
    return run_program(arguments, options);
  }

  // The JSON of a run that has to succeed.
  json analyze_json(std::vector<std::string> arguments, int exit_code = 0) {
    arguments.insert(arguments.begin(), {"--json", "-"});
    const ProgramResult result = analyze(std::move(arguments));
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    const json document = json::parse(result.out, nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << result.out;
    return document;
  }

  bool exists(const std::string& name) const { return fs::exists(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(AnalyzeTest, SeveralAssetsAreOneSceneInTableJsonAndCsv) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result = analyze({"cube.obj", "leg.obj", "--json", "out.json", "--csv", "out.csv"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(complaints(result), IsEmpty());
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("cube"), HasSubstr("leg"), HasSubstr("0.5455"), Not(HasSubstr("\x1b["))));

  const json document = json::parse(TemporaryFolder::read(folder_.path() / "out.json"));
  ASSERT_EQ(document["meshes"].size(), 2U);
  const json& cube = document["meshes"][0];
  EXPECT_EQ(cube["asset"], "cube.obj");
  EXPECT_EQ(cube["triangles"], 12);
  EXPECT_EQ(cube["planar_groups"], 6);
  EXPECT_NEAR(cube["ratings"]["polygons_per_planar_group"].get<double>(), 6.0 / 11, 1e-5);
  EXPECT_EQ(cube["ratings"]["relative_density"], -0.5);
  EXPECT_EQ(cube["ratings"]["fourier_transform"], 0) << "all its triangles have one area";
  EXPECT_TRUE(cube["ratings"]["rendering_time"].is_null());
  const json& leg = document["meshes"][1];
  EXPECT_NEAR(leg["ratings"]["cooccurrence_contrast"].get<double>(), 1.0 / 3, 1e-5);
  EXPECT_EQ(leg["ratings"]["relative_density"], 0.5);
  EXPECT_NE(document["tool"]["device"], "");

  EXPECT_TRUE(follows_schema(folder_.path() / "out.json"));
  const std::string csv = TemporaryFolder::read(folder_.path() / "out.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 3) << csv;
}

TEST_F(AnalyzeTest, TwoRunsGiveTheSameBytesComputedOrRead) {
  folder_.write("leg.obj", leg_obj());
  const ProgramResult first = analyze({"leg.obj", "--no-cache", "--json", "-"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_FALSE(exists("leg.obj.analysis"));
  EXPECT_EQ(analyze({"leg.obj", "--no-cache", "--json", "-"}).out, first.out);
  EXPECT_EQ(analyze({"leg.obj", "--json", "-"}).out, first.out);
  EXPECT_TRUE(exists("leg.obj.analysis"));
  EXPECT_EQ(analyze({"leg.obj", "--json", "-"}).out, first.out);
}

TEST_F(AnalyzeTest, TheSecondRunNeedsNoDevice) {
  folder_.write("cube.obj", cube_obj());
  ProgramOptions options;
  options.environment = kNoDriver;
  const ProgramResult without = analyze({"cube.obj"}, options);
  EXPECT_EQ(without.exit_code, 2) << "otherwise this test proves nothing";
  const ProgramResult first = analyze({"cube.obj"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ProgramResult second = analyze({"cube.obj"}, options);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  EXPECT_THAT(analyze({"cube.obj", "--verbose"}, options).err, HasSubstr("read from its analysis file"));
}

TEST_F(AnalyzeTest, NoDeviceIsExitCode2WithARemedyAndNoOutput) {
  folder_.write("cube.obj", cube_obj());
  ProgramOptions options;
  options.environment = kNoDriver;
  const ProgramResult result = analyze({"cube.obj", "--json", "out.json"}, options);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("mesa-vulkan-drivers")));
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(exists("out.json"));
}

TEST_F(AnalyzeTest, AnUnknownDeviceIsExitCode2) {
  folder_.write("cube.obj", cube_obj());
  const ProgramResult result = analyze({"cube.obj", "--device", "no such device"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("no such device")));
}

TEST_F(AnalyzeTest, StaleAndDamagedAnalysisFilesAreComputedAgain) {
  folder_.write("asset.obj", cube_obj());
  ASSERT_EQ(analyze({"asset.obj"}).exit_code, 0);
  folder_.write("asset.obj", leg_obj());
  const ProgramResult stale = analyze({"asset.obj"});
  EXPECT_EQ(stale.exit_code, 0);
  EXPECT_THAT(lines_with(stale.err, "warning: "), ElementsAre(HasSubstr("computed again")));
  EXPECT_THAT(stale.out, HasSubstr("leg"));
  const std::string whole = TemporaryFolder::read(folder_.path() / "asset.obj.analysis");
  folder_.write("asset.obj.analysis", whole.substr(0, whole.size() - 7));
  const ProgramResult damaged = analyze({"asset.obj"});
  EXPECT_EQ(damaged.exit_code, 0);
  EXPECT_THAT(lines_with(damaged.err, "warning: "), ElementsAre(HasSubstr("computed again")));
  EXPECT_EQ(damaged.out, stale.out);
  EXPECT_THAT(complaints(analyze({"asset.obj"})), IsEmpty());
}

TEST_F(AnalyzeTest, PlacesThatCannotBeWrittenAreNoFailure) {
  folder_.write("a.obj", cube_obj());
  folder_.write("b.obj", leg_obj());
  const ProgramResult result = analyze({"a.obj", "b.obj", "--cache-dir", "/proc/no-such-folder"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_with(result.err, "warning: "), ElementsAre(HasSubstr("not kept")));
  EXPECT_THAT(result.out, AllOf(HasSubstr("cube"), HasSubstr("leg")));
}

TEST_F(AnalyzeTest, ReadOnlyFoldersAreNoFailure) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere; the test before this one covers the path";
  folder_.write("a.obj", cube_obj());
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramResult result = analyze({"a.obj"});
  fs::permissions(folder_.path(), fs::perms::owner_all);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_with(result.err, "warning: "), ElementsAre(HasSubstr("not kept")));
}

TEST_F(AnalyzeTest, ACacheFolderTakesTheAnalysisFiles) {
  folder_.write("cube.obj", cube_obj());
  ASSERT_EQ(analyze({"cube.obj", "--cache-dir", "cache"}).exit_code, 0);
  EXPECT_FALSE(exists("cube.obj.analysis"));
  const auto is_analysis = [](const auto& entry) { return entry.path().extension() == ".analysis"; };
  EXPECT_EQ(std::ranges::count_if(fs::recursive_directory_iterator(folder_.path() / "cache"), is_analysis),
            1);
}

TEST_F(AnalyzeTest, MetricsLimitWhatIsComputed) {
  folder_.write("cube.obj", cube_obj());
  const json some = analyze_json({"cube.obj", "--metrics", "planar_group_variation"});
  const json& ratings = some["meshes"][0]["ratings"];
  EXPECT_TRUE(ratings["planar_group_variation"].is_number());
  EXPECT_TRUE(ratings["cooccurrence_contrast"].is_null());
  EXPECT_TRUE(ratings["relative_density"].is_null());
  const json all = analyze_json({"cube.obj"});
  EXPECT_TRUE(all["meshes"][0]["ratings"]["cooccurrence_contrast"].is_number());
  EXPECT_EQ(all["meshes"][0]["ratings"]["planar_group_variation"], ratings["planar_group_variation"]);
}

TEST_F(AnalyzeTest, RenderingTimesAreMeasuredStoredAndReused) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const std::vector<std::string> arguments = {"cube.obj",        "leg.obj", "--metrics", "rendering_time",
                                              "--timing-budget", "0.01",    "--steps",   "2",
                                              "--timing-size",   "64x48"};
  const json first = analyze_json(arguments);
  EXPECT_TRUE(first["render_timing"]["device"].is_string());
  EXPECT_EQ(first["render_timing"]["width"], 64);
  EXPECT_EQ(first["render_timing"]["height"], 48);
  EXPECT_EQ(first["render_timing"]["steps"], 2);
  for (const json& mesh : first["meshes"]) {
    EXPECT_GT(mesh["rendering_time"]["mean_ns"].get<double>(), 0);
    EXPECT_GE(mesh["rendering_time"]["rounds"].get<int>(), 1);
    EXPECT_LE(mesh["rendering_time"]["rotations"].get<int>(), 4);
    EXPECT_TRUE(mesh["ratings"]["distance"].is_null());
  }
  const double sum = first["meshes"][0]["ratings"]["rendering_time"].get<double>() +
                     first["meshes"][1]["ratings"]["rendering_time"].get<double>();
  EXPECT_EQ(sum, 1) << "two meshes are the fastest and the slowest";
  EXPECT_EQ(analyze_json(arguments), first) << "not read from the analysis files";
}

TEST_F(AnalyzeTest, TheTableSaysWhoseRenderingTimesTheseAre) {
  folder_.write("cube.obj", cube_obj());
  const ProgramResult result = analyze({"cube.obj", "--timing-budget", "0.01"});
  EXPECT_THAT(result.out, HasSubstr("R_rt was measured on "));
  const bool cpu = lines_with(result.out, "R_rt").front().find("CPU device") != std::string::npos;
  const json document = analyze_json({"cube.obj", "--timing-budget", "0.01"});
  EXPECT_EQ(document["render_timing"]["device_type"] == "cpu", cpu);
}

TEST_F(AnalyzeTest, EyeAndWeightsReachTheRatings) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const json document = analyze_json({"cube.obj", "leg.obj", "--eye", "-1,2,3", "--weights", "distance=1"});
  EXPECT_EQ(document["meshes"][1]["ratings"]["distance"], 1);
  EXPECT_EQ(document["meshes"][0]["aggregate"], 0);
  EXPECT_EQ(document["meshes"][1]["aggregate"], 1);
}

TEST_F(AnalyzeTest, EveryAssetKeepsItsPlaceWhateverBecomesOfTheOthers) {
  // The torus' start triangle is still searched for when the bad asset is tried.
  folder_.write("torus.obj", obj_of(test_meshes::torus(100, 60), "torus"));
  folder_.write("cube.obj", cube_obj());
  folder_.write("bad.obj", "no model");
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result =
      analyze({"--json", "-", "torus.obj", "bad.obj", "cube.obj", "torus.obj", "leg.obj", "bad.obj"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result), ElementsAre(HasSubstr("bad.obj")));
  const json document = json::parse(result.out);
  ASSERT_EQ(document["meshes"].size(), 4U);
  const std::vector<std::string> expected = {"torus.obj", "cube.obj", "torus.obj", "leg.obj"};
  for (std::size_t row = 0; row < expected.size(); ++row) {
    const json& mesh = document["meshes"][row];
    EXPECT_EQ(mesh["asset"], expected[row]);
    const json alone = analyze_json({"--no-cache", expected[row]})["meshes"][0];
    EXPECT_EQ(mesh["ratings"]["fourier_transform"], alone["ratings"]["fourier_transform"]);
    EXPECT_EQ(mesh["signal"], alone["signal"]);
  }
}

TEST_F(AnalyzeTest, AnAssetGivenTwiceHasItsRowsTwice) {
  folder_.write("cube.obj", cube_obj());
  const json document = analyze_json({"cube.obj", "./cube.obj"});
  ASSERT_EQ(document["meshes"].size(), 2U);
  EXPECT_EQ(document["meshes"][0]["asset"], "cube.obj");
  EXPECT_EQ(document["meshes"][1]["asset"], "./cube.obj");
  EXPECT_EQ(document["meshes"][0]["ratings"], document["meshes"][1]["ratings"]);
}

TEST_F(AnalyzeTest, AssetsWithOtherUnitsOrAxesAreAWarning) {
  folder_.write("metres.gltf", gltf_triangle("metres.bin"));
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder_.write("metres.bin", std::string(reinterpret_cast<const char*>(positions), sizeof positions));
  folder_.write("centimetres.fbx", fbx_triangle());
  const ProgramResult result = analyze({"metres.gltf", "centimetres.fbx"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(complaints(result), ElementsAre(AllOf(HasSubstr("unit"), HasSubstr("metres.gltf has 1"),
                                                    HasSubstr("centimetres.fbx has 0.01")),
                                              AllOf(HasSubstr("up axis"), HasSubstr("+Z"))));
}

TEST_F(AnalyzeTest, NamesWithDashesCommasAndSpaces) {
  folder_.write("-dash.obj", cube_obj());
  folder_.write("com,ma and space.obj", cube_obj());
  const json document = analyze_json({"--", "-dash.obj", "com,ma and space.obj"});
  EXPECT_EQ(document["meshes"].size(), 2U);
}

TEST_F(AnalyzeTest, QuietSaysNothingButErrors) {
  folder_.write("cube.obj", cube_obj());
  ASSERT_EQ(analyze({"cube.obj"}).exit_code, 0);
  folder_.write("cube.obj", leg_obj());  // stale: would be a warning
  const ProgramResult result = analyze({"cube.obj", "missing.obj", "--quiet", "--json", "-"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("missing.obj"), Not(HasSubstr("warning"))));
}

TEST_F(AnalyzeTest, ColourOnlyWhereItIsWanted) {
  folder_.write("cube.obj", cube_obj());
  ProgramOptions options;
  options.terminal = true;
  options.environment = {{"TERM", "xterm-256color"}, {"NO_COLOR", ""}};
  const ProgramResult colored = analyze({"cube.obj"}, options);
  EXPECT_EQ(colored.exit_code, 0);
  EXPECT_THAT(colored.out, HasSubstr("\x1b["));
  options.environment["NO_COLOR"] = "1";
  EXPECT_THAT(analyze({"cube.obj"}, options).out, AllOf(HasSubstr("cube"), Not(HasSubstr("\x1b["))));
  options.environment["NO_COLOR"] = "";
  options.environment["TERM"] = "dumb";
  EXPECT_THAT(analyze({"cube.obj"}, options).out, AllOf(HasSubstr("cube"), Not(HasSubstr("\x1b["))));
}

TEST_F(AnalyzeTest, TheValidationLayerFindsNothing) {
  const char* wanted = std::getenv("SCENE_ANALYZER_VALIDATION");
  if (wanted != nullptr && std::string_view(wanted) == "0")
    GTEST_SKIP() << "sanitizer builds run without the layer: it leaks itself";
  folder_.write("cube.obj", cube_obj());
  ProgramOptions options;
  options.environment = {{"SCENE_ANALYZER_VALIDATION", "1"}};
  const ProgramResult result = analyze({"cube.obj", "--no-cache"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  options.environment = {{"SCENE_ANALYZER_VALIDATION", "maybe"}};
  EXPECT_EQ(analyze({"cube.obj", "--no-cache"}, options).exit_code, 2);
}

}  // namespace
}  // namespace scene_analyzer
