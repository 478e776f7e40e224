#include "cli/analyze_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Arguments = std::vector<std::string>;

std::string refusal(const Arguments& arguments) {
  try {
    parse_analyze(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused: " << testing::PrintToString(arguments);
  return "";
}

TEST(AnalyzeOptions, DefaultsAreThoseOfTheFaces) {
  const AnalyzeRequest request = parse_analyze(Arguments{"room.glb"});
  EXPECT_THAT(request.assets, ElementsAre("room.glb"));
  EXPECT_EQ(request.pipeline.parameters, analysis::Parameters());
  EXPECT_TRUE(request.pipeline.metrics.all());
  EXPECT_TRUE(request.pipeline.use_analysis_files);
  EXPECT_FALSE(request.pipeline.cache_folder);
  EXPECT_FALSE(request.ratings.relative);
  EXPECT_FALSE(request.ratings.eye);
  EXPECT_FALSE(request.defects);
  EXPECT_FALSE(request.json);
  EXPECT_FALSE(request.csv);
  EXPECT_FALSE(request.histograms);
  EXPECT_FALSE(request.signals);
  EXPECT_TRUE(request.table());
  EXPECT_EQ(request.device, "");
  EXPECT_EQ(request.log, LogLevel::kNormal);
}

TEST(AnalyzeOptions, EveryOptionArrives) {
  const TemporaryFolder folder;
  const AnalyzeRequest request = parse_analyze(Arguments{"a.obj",
                                                         "--alpha",
                                                         "2.5",
                                                         "--dim=100",
                                                         "--steps",
                                                         "16",
                                                         "--start-searches",
                                                         "7",
                                                         "--defects",
                                                         "--signals",
                                                         (folder.path() / "new").string(),
                                                         "--weld-tolerance",
                                                         "1e-4",
                                                         "--metrics",
                                                         "distance,planar_group_variation",
                                                         "--eye",
                                                         "-1,2,3",
                                                         "--weights",
                                                         "distance=3",
                                                         "--relative",
                                                         "--json",
                                                         "-",
                                                         "--csv",
                                                         (folder.path() / "out.csv").string(),
                                                         "--device",
                                                         "llvm",
                                                         "--cache-dir",
                                                         folder.path().string(),
                                                         "--verbose",
                                                         "b.obj"});
  EXPECT_THAT(request.assets, ElementsAre("a.obj", "b.obj"));
  EXPECT_EQ(request.pipeline.parameters,
            (analysis::Parameters{
                .alpha_degrees = 2.5, .dim = 100, .weld_tolerance = 1e-4, .steps = 16, .start_searches = 7}));
  EXPECT_EQ(request.pipeline.metrics.count(), 2U);
  EXPECT_EQ(request.ratings.metrics, request.pipeline.metrics);
  EXPECT_EQ(request.ratings.eye, (mesh::Vector3{-1, 2, 3}));
  EXPECT_EQ(request.ratings.weights[index_of(analysis::Metric::kDistance)], 3);
  EXPECT_EQ(request.ratings.weights[index_of(analysis::Metric::kPlanarGroupVariation)], 0);
  EXPECT_TRUE(request.ratings.relative);
  EXPECT_EQ(request.json, "-");
  EXPECT_FALSE(request.table());
  EXPECT_EQ(request.signals, folder.path() / "new");
  EXPECT_TRUE(request.defects);
  EXPECT_EQ(request.device, "llvm");
  EXPECT_EQ(request.pipeline.cache_folder, folder.path());
  EXPECT_EQ(request.log, LogLevel::kVerbose);
}

TEST(AnalyzeOptions, NegativeValuesInBothSpellings) {
  EXPECT_EQ(parse_analyze(Arguments{"--eye", "-1,-2,-3", "a.obj"}).ratings.eye, (mesh::Vector3{-1, -2, -3}));
  EXPECT_EQ(parse_analyze(Arguments{"--eye=-1,2,3", "a.obj"}).ratings.eye, (mesh::Vector3{-1, 2, 3}));
}

TEST(AnalyzeOptions, AssetsMayHaveAnyName) {
  EXPECT_THAT(parse_analyze(Arguments{"--quiet", "--", "-odd.obj", "--json", "--", "a,b.obj"}).assets,
              ElementsAre("-odd.obj", "--json", "--", "a,b.obj"));
  EXPECT_THAT(parse_analyze(Arguments{"a,b.obj", "c d.obj"}).assets, ElementsAre("a,b.obj", "c d.obj"));
}

TEST(AnalyzeOptions, ValuesOutOfRange) {
  const auto with = [](const char* option, const char* value) { return refusal({"a.obj", option, value}); };
  EXPECT_THAT(with("--alpha", "-1"),
              AllOf(HasSubstr("--alpha"), HasSubstr("'-1'"), HasSubstr("[0, 180] degrees")));
  EXPECT_THAT(with("--alpha", "180.5"), HasSubstr("[0, 180]"));
  EXPECT_THAT(with("--alpha", "nan"), HasSubstr("[0, 180]"));
  EXPECT_THAT(with("--dim", "1"), HasSubstr("[2, 4294967295]"));
  EXPECT_THAT(with("--dim", "-5"), HasSubstr("[2, 4294967295]"));
  EXPECT_THAT(with("--steps", "0"), HasSubstr("[1, 256]"));
  EXPECT_THAT(with("--steps", "257"), HasSubstr("[1, 256]"));
  EXPECT_THAT(with("--start-searches", "0"),
              AllOf(HasSubstr("--start-searches"), HasSubstr("[1, 4294967295]")));
  EXPECT_THAT(with("--start-searches", "1.5"), HasSubstr("[1, 4294967295]"));
  EXPECT_THAT(with("--signals", ""), HasSubstr("--signals needs a folder"));
  EXPECT_THAT(with("--histograms", ""), HasSubstr("--histograms needs a folder"));
  EXPECT_THAT(with("--weld-tolerance", "-1e-9"), HasSubstr(">= 0"));
  EXPECT_THAT(with("--metrics", "beauty"), HasSubstr("known are"));
  EXPECT_THAT(with("--eye", "1,2"), HasSubstr("X,Y,Z"));
  EXPECT_THAT(with("--device", ""), HasSubstr("--device"));
  EXPECT_THAT(with("--cache-dir", ""), HasSubstr("--cache-dir"));
  EXPECT_THAT(with("--json", ""), HasSubstr("--json"));
}

TEST(AnalyzeOptions, ContradictionsAndGaps) {
  EXPECT_THAT(refusal({}), HasSubstr("no asset"));
  EXPECT_THAT(refusal({"--relative"}), HasSubstr("no asset"));
  EXPECT_THAT(refusal({""}), HasSubstr("empty"));
  EXPECT_THAT(refusal({"a.obj", "--json", "-", "--csv", "-"}), HasSubstr("both"));
  EXPECT_THAT(refusal({"a.obj", "--json", "x", "--csv", "./x"}), HasSubstr("same file"));
  EXPECT_THAT(refusal({"a.obj", "--quiet", "--verbose"}), HasSubstr("contradict"));
  EXPECT_THAT(refusal({"a.obj", "--no-cache", "--cache-dir", "."}), HasSubstr("contradict"));
  EXPECT_THAT(refusal({"a.obj", "--metrics", "distance", "--weights", "relative_density=1"}),
              HasSubstr("no weight"));
  EXPECT_THAT(refusal({"a.obj", "--alpha", "1", "--alpha", "2"}), HasSubstr("twice"));
  EXPECT_THAT(refusal({"a.obj", "--alpha"}), AllOf(HasSubstr("--alpha needs a value"), HasSubstr("DEG")));
  EXPECT_THAT(refusal({"--json", "--quiet", "a.obj"}), HasSubstr("--json needs a value"));
  EXPECT_THAT(refusal({"a.obj", "--quiet=yes"}), HasSubstr("takes no value"));
}

TEST(AnalyzeOptions, UnknownOptionsSuggestTheNearest) {
  EXPECT_THAT(refusal({"a.obj", "--alpa", "1"}),
              AllOf(HasSubstr("'--alpa'"), HasSubstr("did you mean --alpha?")));
  EXPECT_THAT(refusal({"a.obj", "--cashe-dir=x"}), HasSubstr("--cache-dir"));
  EXPECT_THAT(refusal({"a.obj", "--frobnicate"}), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(refusal({"-odd.obj"}), HasSubstr("--"));
  EXPECT_THAT(refusal({"-x", "a.obj"}), HasSubstr("x"));
  EXPECT_THAT(refusal({"---", "a.obj"}), HasSubstr("---"));
}

TEST(AnalyzeOptions, OutputsAreCheckedBeforeAnyWork) {
  const TemporaryFolder folder;
  const std::string inside = (folder.path() / "nowhere" / "out.json").string();
  EXPECT_THAT(refusal({"a.obj", "--json", folder.path().string()}), HasSubstr("is a folder"));
  EXPECT_THAT(refusal({"a.obj", "--json", inside}), HasSubstr("does not exist"));
  const std::string asset = folder.write("a.obj", "v 0 0 0\n").string();
  EXPECT_THAT(refusal({asset, "--csv", asset}), HasSubstr("overwritten"));
  EXPECT_THAT(refusal({asset, "--cache-dir", asset}), HasSubstr("is a file"));
  EXPECT_THAT(refusal({asset, "--signals", asset}), AllOf(HasSubstr("--signals"), HasSubstr("is a file")));
}

TEST(AnalyzeOptions, HelpNamesEveryOptionMetricAndExitCode) {
  EXPECT_TRUE(parse_analyze(Arguments{"--help"}).help);
  EXPECT_TRUE(parse_analyze(Arguments{"-h"}).help);
  const std::string help = analyze_help();
  for (const char* option :
       {"--alpha DEG",     "--dim N",       "--steps N",          "--metrics KEY",      "--eye X,Y,Z",
        "--weights KEY=W", "--relative",    "--weld-tolerance L", "--start-searches N", "--histograms DIR",
        "--signals DIR",   "--json FILE|-", "--csv FILE|-",       "--device D",         "--cache-dir DIR",
        "--no-cache",      "--quiet",       "--verbose",          "Examples:",          "Exit codes:"})
    EXPECT_THAT(help, HasSubstr(option));
  EXPECT_THAT(help, AllOf(HasSubstr("default 20000"), HasSubstr("gap"))) << "what a mark in the table means";
  for (const auto key : analysis::kMetricKeys) EXPECT_THAT(help, HasSubstr(std::string(key)));
}

TEST(AnalyzeOptions, LimitsOfTheImport) {
  const auto limits = parse_analyze(Arguments{"a.glb"}).pipeline.import_limits;
  EXPECT_EQ(limits.memory_bytes, 0U);
  EXPECT_EQ(limits.seconds, 120);
  EXPECT_EQ(limits.triangles, 0U);
  const auto given = parse_analyze(Arguments{"a.glb", "--import-memory", "1.5G", "--import-timeout", "0.5",
                                             "--max-triangles", "1000000"})
                         .pipeline.import_limits;
  EXPECT_EQ(given.memory_bytes, std::uint64_t{3} << 29);
  EXPECT_EQ(given.seconds, 0.5);
  EXPECT_EQ(given.triangles, 1000000U);
  EXPECT_THAT(refusal({"a.glb", "--import-memory", "63M"}), HasSubstr("less than 64M"));
  EXPECT_THAT(refusal({"a.glb", "--import-memory", "much"}), HasSubstr("--import-memory: 'much'"));
  EXPECT_THAT(refusal({"a.glb", "--import-timeout", "0"}), HasSubstr("--import-timeout: '0'"));
  EXPECT_THAT(refusal({"a.glb", "--max-triangles", "0"}), HasSubstr("--max-triangles: '0'"));
}

}  // namespace
}  // namespace scene_analyzer::cli
