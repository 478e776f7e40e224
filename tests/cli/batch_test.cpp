// `batch` and `merge` as a user runs them: folders, shards, killed runs, bad assets, exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

class BatchTest : public testing::Test {
 protected:
  // `count` assets, every third of which in a folder of its own.
  void make_library(int count) const {
    for (int i = 0; i < count; ++i) {
      const std::string name =
          i % 3 == 0 ? fmt::format("library/sub{}/a.obj", i) : fmt::format("library/{}.obj", i);
      fs::create_directories((folder_.path() / name).parent_path());
      folder_.write(name,
                    fmt::format("v {} 0 0\n{}", i + 10, obj_of(cli::prism(3 + i, 1, 0.1 + i, 1), "prism")));
    }
  }
  ProgramResult run(std::vector<std::string> arguments,
                    const std::map<std::string, std::string>& environment = {}) const {
    if (arguments.front() == "batch") arguments.insert(arguments.end(), {"--metrics", kUntimedMetrics});
    return run_program(arguments, {.environment = environment, .folder = folder_.path()});
  }
  std::string merged(const std::string& out) const {
    const ProgramResult result = run({"merge", out, "--csv", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
  // Lines of all journals of the output folder so far.
  std::ptrdiff_t journal_lines(const std::string& out) const {
    std::ptrdiff_t lines = 0;
    std::error_code none_yet;
    for (const auto& entry : fs::directory_iterator(folder_.path() / out / "journal", none_yet)) {
      std::ifstream journal(entry.path());
      lines += std::count(std::istreambuf_iterator<char>(journal), {}, '\n');
    }
    return lines;
  }
  static nlohmann::json summary(const ProgramResult& result) { return nlohmann::json::parse(result.out); }

  TemporaryFolder folder_;
};

TEST_F(BatchTest, AnalysesALibraryAndGoesOnWhereNothingChanged) {
  make_library(12);
  const ProgramResult first = run({"batch", "library", "--out", "out"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, StartsWith("12 assets: 12 analysed; "));
  EXPECT_THAT(complaints(first), IsEmpty());
  const ProgramResult second = run({"batch", "library", "--out", "out"});
  EXPECT_THAT(second.out, StartsWith("12 assets: 12 analysed (12 of them unchanged); "));
  const ProgramResult merge = run({"merge", "out"});
  EXPECT_EQ(merge.exit_code, 0) << merge.err;
  EXPECT_THAT(merge.out, AllOf(StartsWith("12 assets, "), HasSubstr("highest aggregate:")));
}

TEST_F(BatchTest, RatesAsAnalyzeDoesButForDistances) {
  make_library(9);
  run({"batch", "library", "--out", "out"});
  std::vector<std::string> analyze = {"analyze", "--json", "-", "--weights",
                                      "relative_density=1,cooccurrence_contrast=2"};
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "library"))
    if (entry.is_regular_file()) analyze.push_back(entry.path().lexically_relative(folder_.path()).string());
  std::sort(analyze.begin() + 5, analyze.end());
  const auto expected = summary(run(analyze));
  const auto library = summary(run({"merge", "out", "--json", "-", "--weights",
                                    "relative_density=1,cooccurrence_contrast=2", "--top", "1"}));
  EXPECT_EQ(library["density_mean"], expected["scene"]["density_mean"]);
  EXPECT_EQ(library["meshes"]["count"], expected["scene"]["mesh_count"]);
  double worst = 0;
  for (const auto& mesh : expected["meshes"]) worst = std::max(worst, mesh["aggregate"].get<double>());
  EXPECT_EQ(library["top"]["aggregate"][0]["value"], worst);
}

TEST_F(BatchTest, ShardsComeToTheSameAsOneRun) {
  make_library(20);
  run({"batch", "library", "--out", "whole"});
  for (const char* index : {"2", "0", "1"}) {
    EXPECT_EQ(run({"merge", "out", "--quiet"}).exit_code, index[0] == '2' ? 2 : 1);
    const ProgramResult shard =
        run({"batch", "library", "--out", "out", "--shard", "auto"},
            {{"SLURM_ARRAY_TASK_ID", index}, {"SLURM_ARRAY_TASK_MIN", "0"}, {"SLURM_ARRAY_TASK_COUNT", "3"}});
    EXPECT_EQ(shard.exit_code, 0) << shard.err;
  }
  EXPECT_EQ(merged("out"), merged("whole"));
}

TEST_F(BatchTest, OneBadAssetIsARowWithItsReason) {
  make_library(4);
  folder_.write("library/bad.glb", "no glTF at all");
  folder_.write("library/empty.obj", "");
  const ProgramResult result = run({"batch", "library", "--out", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, StartsWith("6 assets: 4 analysed, 2 failed; "));
  EXPECT_THAT(lines_with(result.err, "error: "), SizeIs(2));
  const ProgramResult merge = run({"merge", "out", "--json", "-"});
  EXPECT_EQ(merge.exit_code, 3);
  EXPECT_EQ(summary(merge)["assets"]["failed"], 2);
  EXPECT_THAT(summary(merge)["assets"]["not_analysed"][0]["reason"].get<std::string>(), HasSubstr("bad.glb"));
  fs::remove(folder_.path() / "library/bad.glb");
  folder_.write("library/empty.obj", leg_obj());
  EXPECT_EQ(run({"batch", "library", "--out", "out"}).exit_code, 0);
  EXPECT_EQ(run({"merge", "out", "--quiet"}).exit_code, 0)
      << "what is no longer in the library does not count";
}

TEST_F(BatchTest, ARunThatIsKilledTimeAndAgainComesToTheSame) {
  make_library(90);
  const auto started = std::chrono::steady_clock::now();
  run({"batch", "library", "--out", "whole"});
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - started;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.05, 0.8);
  int met = 0;
  for (int i = 0; i < 8; ++i) {
    RunningProgram program({"batch", "library", "--out", "out", "--metrics", kUntimedMetrics},
                           {.environment = {}, .folder = folder_.path(), .terminal = false});
    std::this_thread::sleep_for(once * part(random));
    met += program.has_ended() ? 0 : 1;
    program.send(SIGKILL);
    program.wait();
  }
  EXPECT_GT(met, 0);
  EXPECT_EQ(run({"batch", "library", "--out", "out"}).exit_code, 0);
  EXPECT_EQ(merged("out"), merged("whole"));
  std::size_t journals = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_.path() / "out" / "journal"))
    ++journals;
  EXPECT_EQ(journals, 1U) << "journals of killed runs are left";
}

TEST_F(BatchTest, TheSameTaskTwiceAtOnceDoesNoHarm) {
  make_library(30);
  run({"batch", "library", "--out", "whole"});
  const std::vector<std::string> arguments = {"batch", "library",   "--out",
                                              "out",   "--metrics", kUntimedMetrics};
  const ProgramOptions options{.environment = {}, .folder = folder_.path(), .terminal = false};
  RunningProgram one(arguments, options), other(arguments, options);
  EXPECT_EQ(one.wait().exit_code, 0);
  EXPECT_EQ(other.wait().exit_code, 0);
  EXPECT_EQ(merged("out"), merged("whole"));
}

TEST_F(BatchTest, ListsAndGlobsNameTheLibrary) {
  make_library(6);
  folder_.write("list.txt", "library/1.obj\nlibrary/2.obj\n");
  EXPECT_THAT(run({"batch", "list.txt", "--out", "a"}).out, StartsWith("2 assets: 2 analysed"));
  EXPECT_THAT(run({"batch", "library", "--out", "b", "--include", "sub*,1.obj", "--exclude", "sub3/*"}).out,
              StartsWith("2 assets: 2 analysed"));
  const ProgramResult nothing = run({"batch", "library", "--out", "c", "--include", "*.nothing"});
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_THAT(nothing.err, HasSubstr("holds no assets"));
}

TEST_F(BatchTest, ASignalStopsItAndTheNextRunGoesOn) {
  make_library(200);
  RunningProgram program({"batch", "library", "--out", "out", "--metrics", kUntimedMetrics},
                         {.environment = {}, .folder = folder_.path(), .terminal = false});
  while (!program.has_ended() && journal_lines("out") < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGTERM);
  const ProgramResult stopped = program.wait();
  EXPECT_EQ(stopped.exit_code, 143);
  EXPECT_THAT(stopped.err, HasSubstr("stopped"));
  const ProgramResult rest = run({"batch", "library", "--out", "out"});
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_THAT(rest.out, AllOf(StartsWith("200 assets: 200 analysed ("), HasSubstr(" of them unchanged")));
}

TEST_F(BatchTest, WrongUseIsSaidBeforeAnyWork) {
  make_library(1);
  const auto refusal = [&](std::vector<std::string> arguments) {
    const ProgramResult result = run(std::move(arguments));
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_THAT(refusal({"batch", "library"}), HasSubstr("--out is missing"));
  EXPECT_THAT(refusal({"batch", "--out", "out"}), HasSubstr("no library is named"));
  EXPECT_THAT(refusal({"batch", "nowhere", "--out", "out"}), HasSubstr("'nowhere' does not exist"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "out", "--shard-index", "1"}),
              HasSubstr("belong together"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "out", "--shard-index", "2", "--shard-count", "2"}),
              HasSubstr("2 shards are 0 to 1"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "out", "--shard", "auto"}), HasSubstr("no scheduler's"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "out", "--jobs", "0"}), HasSubstr("--jobs"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "out", "--include", "a,,b"}), HasSubstr("empty glob"));
  EXPECT_THAT(refusal({"batch", "library", "--out", "/proc/nowhere"}), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal({"merge"}), HasSubstr("one folder is needed"));
  EXPECT_THAT(refusal({"merge", "out", "--json", "-", "--csv", "-"}), HasSubstr("standard output"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  const ProgramResult nothing = run({"merge", "library"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("is 'library' the folder that batch --out was given?"));
}

}  // namespace
}  // namespace scene_analyzer
