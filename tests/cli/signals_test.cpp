// `scene-analyzer analyze --signals DIR` as a user runs it, and the files it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/assets.h"
#include "cli/mesh_files.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// The second column of a table whose first one counts from 0.
std::vector<double> read_column(const std::string& text, const std::string& head) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, head);
  std::vector<double> values;
  while (std::getline(stream, line)) {
    const std::size_t comma = line.find(',');
    EXPECT_EQ(line.substr(0, comma), std::to_string(values.size()));
    values.push_back(std::stod(line.substr(comma + 1)));
  }
  return values;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

class SignalsTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }

  std::string read(const std::string& name) const { return TemporaryFolder::read(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(SignalsTest, TwoTablesAndAPicturePerMeshThatAgreeWithTheReport) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result =
      analyze({"cube.obj", "cube.obj", "leg.obj", "--signals", "a/b", "--json", "out.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(complaints(result), IsEmpty());
  EXPECT_THAT(files_in(folder_.path() / "a/b"),
              UnorderedElementsAre("0-cube-signal.csv", "0-cube-signal.svg", "0-cube-spectrum.csv",
                                   "2-leg-signal.csv", "2-leg-signal.svg", "2-leg-spectrum.csv"));
  const json leg = json::parse(read("out.json"))["meshes"][2];
  const auto areas = read_column(read("a/b/2-leg-signal.csv"), "index,area");
  const auto magnitudes = read_column(read("a/b/2-leg-spectrum.csv"), "k,magnitude");
  ASSERT_EQ(areas.size(), 40U);
  ASSERT_EQ(magnitudes.size(), 21U);
  EXPECT_EQ(leg["signal"]["length"], 40);
  EXPECT_EQ(leg["signal"]["gap"], 0);
  EXPECT_NEAR(leg["ratings"]["fourier_transform"].get<double>(), 0.09168, 1e-5);
  double sum = 0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, leg["surface_area"].get<double>(), 1e-9 * sum);
  EXPECT_NEAR(magnitudes[0], sum, 1e-9 * sum);
  double largest = 0, total = 0, weighted = 0;
  for (std::size_t k = 1; k < magnitudes.size(); ++k) {
    largest = std::max(largest, magnitudes[k]);
    total += magnitudes[k];
    weighted += static_cast<double>(k) * magnitudes[k];
  }
  EXPECT_NEAR(largest / magnitudes[0] * weighted / (20 * total),
              leg["ratings"]["fourier_transform"].get<double>(), 1e-6);
  EXPECT_THAT(read("a/b/2-leg-signal.svg"),
              AllOf(HasSubstr(">leg</text>"), HasSubstr("N = 40"), HasSubstr("R_ft = 0.0917")));
}

TEST_F(SignalsTest, AValidAnalysisFileDoesNotKeepThemFromBeingComputed) {
  folder_.write("leg.obj", leg_obj());
  const ProgramResult first = analyze({"leg.obj", "--json", "-"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ProgramResult second = analyze({"leg.obj", "--json", "-", "--signals", "out"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  const std::string csv = read("out/0-leg-signal.csv"), svg = read("out/0-leg-signal.svg");
  EXPECT_NE(csv, "");
  EXPECT_EQ(analyze({"leg.obj", "--signals", "out", "--no-cache", "--metrics", "distance"}).exit_code, 0);
  EXPECT_EQ(read("out/0-leg-signal.csv"), csv);
  EXPECT_EQ(read("out/0-leg-signal.svg"), svg) << "the same every time, with the rating also unasked for";
}

TEST_F(SignalsTest, OneFolderHoldsHistogramsToo) {
  folder_.write("cube.obj", cube_obj());
  ASSERT_EQ(analyze({"cube.obj", "--signals", "out", "--histograms", "out"}).exit_code, 0);
  EXPECT_THAT(files_in(folder_.path() / "out"),
              UnorderedElementsAre("0-cube.csv", "0-cube.svg", "0-cube-signal.csv", "0-cube-signal.svg",
                                   "0-cube-spectrum.csv"));
}

TEST_F(SignalsTest, FilesThatCannotBeWrittenAreExitCode3AndTheTableIsPrinted) {
  folder_.write("cube.obj", cube_obj());
  fs::create_directories(folder_.path() / "out/0-cube-signal.csv");
  const ProgramResult result = analyze({"cube.obj", "--signals", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("0-cube-signal.csv")));
  EXPECT_THAT(result.out, HasSubstr("0.5455"));
}

TEST_F(SignalsTest, FoldersThatCannotBeAreExitCode2) {
  folder_.write("cube.obj", cube_obj());
  for (const std::string folder : {"", "cube.obj", "cube.obj/sub"}) {
    const ProgramResult result = analyze({"cube.obj", "--signals", folder});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("--signals")));
    EXPECT_EQ(result.out, "");
  }
}

// Two instances of one mesh, the first of them twice as large as the file's own coordinates.
analysis::AssetAnalysis made_up() {
  analysis::AssetAnalysis analysis;
  analysis.asset = "room.glb";
  analysis.geometries.resize(1);
  analysis.geometries[0].fourier_transform = 0.98019802;
  analysis.geometries[0].signal = {.length = 2, .start_triangle = 1, .mean_distance = 3, .gap = 0.5};
  analysis.instances.resize(2);
  analysis.instances[0].node = "../lamp 1";
  analysis.instances[0].area_scale = 4;
  return analysis;
}

TEST(WriteSignal, IsOfTheFirstRowThatShowsTheMesh) {
  const TemporaryFolder folder;
  cli::MeshFiles files(folder.path(), "signals");
  files.start_asset(10);
  const std::vector<double> areas = {100, 1}, magnitudes = {101, 99};
  cli::write_signal(files, made_up(), 0, {areas, magnitudes});
  EXPECT_THAT(files.take_errors(), IsEmpty());
  EXPECT_THAT(files_in(folder.path()),
              UnorderedElementsAre("10-.._lamp_1-signal.csv", "10-.._lamp_1-signal.svg",
                                   "10-.._lamp_1-spectrum.csv"));
  const auto read = [&](const char* end) {
    return TemporaryFolder::read(folder.path() / (std::string("10-.._lamp_1-") + end));
  };
  EXPECT_EQ(read("signal.csv"), "index,area\n0,400\n1,4\n");
  EXPECT_EQ(read("spectrum.csv"), "k,magnitude\n0,404\n1,396\n");
  EXPECT_THAT(read("signal.svg"), AllOf(HasSubstr("distance to the others 6 units"), HasSubstr("Gap 50 %")));
}

TEST(WriteSignal, CollectsWhatCannotBeWritten) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "0-.._lamp_1-spectrum.csv");
  cli::MeshFiles files(folder.path(), "signals");
  files.start_asset(0);
  cli::write_signal(files, made_up(), 0, {});
  EXPECT_THAT(files.take_errors(), ElementsAre(HasSubstr("0-.._lamp_1-spectrum.csv")));
  EXPECT_THAT(files.take_errors(), IsEmpty()) << "each is told once";
}

}  // namespace
}  // namespace scene_analyzer
