// `scene-analyzer analyze --histograms DIR` as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "cli/assets.h"
#include "cli/mesh_files.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Matrix = std::map<std::pair<std::string, std::string>, std::uint64_t>;

Matrix read_csv(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "area_row,area_column,count");
  Matrix matrix;
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    std::string row, column, count;
    std::getline(std::getline(std::getline(fields, row, ','), column, ','), count);
    EXPECT_TRUE(matrix.emplace(std::pair(row, column), std::stoull(count)).second) << line;
  }
  return matrix;
}

class HistogramsTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }

  std::vector<std::string> files(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  std::string read(const std::string& name) const { return TemporaryFolder::read(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(HistogramsTest, ATableAndAPicturePerMeshNumberedByRow) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result = analyze({"cube.obj", "cube.obj", "leg.obj", "--histograms", "a/b"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files("a/b"), ElementsAre("0-cube.csv", "0-cube.svg", "2-leg.csv", "2-leg.svg"));

  const Matrix cube = read_csv(read("a/b/0-cube.csv"));
  ASSERT_EQ(cube.size(), 1U) << "all triangles of a cube have one area";
  EXPECT_EQ(cube.begin()->second, 36U) << "12 triangles with 3 neighbours each";

  std::uint64_t sum = 0;
  const Matrix leg = read_csv(read("a/b/2-leg.csv"));
  for (const auto& [areas, count] : leg) {
    sum += count;
    EXPECT_EQ(leg.at({areas.second, areas.first}), count);
  }
  EXPECT_EQ(sum, 120U) << "40 triangles with 3 neighbours each";
  EXPECT_THAT(read("a/b/2-leg.svg"), AllOf(HasSubstr("<svg"), HasSubstr("leg"), HasSubstr("</svg>")));
}

TEST_F(HistogramsTest, AValidAnalysisFileDoesNotKeepThemFromBeingComputed) {
  folder_.write("leg.obj", leg_obj());
  const ProgramResult first = analyze({"leg.obj", "--json", "-"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  ASSERT_TRUE(fs::exists(folder_.path() / "leg.obj.analysis"));
  const ProgramResult second = analyze({"leg.obj", "--json", "-", "--histograms", "out"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  const std::string csv = read("out/0-leg.csv"), svg = read("out/0-leg.svg");
  EXPECT_EQ(analyze({"leg.obj", "--histograms", "out", "--no-cache", "--metrics", "distance"}).exit_code, 0);
  EXPECT_EQ(read("out/0-leg.csv"), csv);
  EXPECT_EQ(read("out/0-leg.svg"), svg);
}

TEST_F(HistogramsTest, FilesThatCannotBeWrittenAreExitCode3AndTheTableIsPrinted) {
  folder_.write("cube.obj", cube_obj());
  fs::create_directories(folder_.path() / "out/0-cube.csv");
  const ProgramResult result = analyze({"cube.obj", "--histograms", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("0-cube.csv")));
  EXPECT_THAT(result.out, HasSubstr("0.5455"));
}

TEST_F(HistogramsTest, FoldersThatCannotBeAreExitCode2) {
  folder_.write("cube.obj", cube_obj());
  for (const std::string folder : {"", "cube.obj", "cube.obj/sub"}) {
    const ProgramResult result = analyze({"cube.obj", "--histograms", folder});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("--histograms")));
    EXPECT_EQ(result.out, "");
  }
}

TEST(MeshStem, IsAFileNameWhateverTheMeshIsCalled) {
  EXPECT_EQ(cli::mesh_stem(7, "leg"), "7-leg");
  EXPECT_EQ(cli::mesh_stem(0, "../a b\n/\xc3\xa4.x"), "0-.._a_b____.x");
  EXPECT_EQ(cli::mesh_stem(12, std::string(500, 'y')), "12-" + std::string(60, 'y'));
  EXPECT_EQ(cli::mesh_stem(3, ""), "3-");
}

TEST(MeshFiles, ARefusedTableIsAWarningAndTheOldOneGoes) {
  const TemporaryFolder folder;
  folder.write("4-leg.csv", "of an earlier run");
  cli::MeshFiles files(folder.path(), "histograms");
  analysis::AssetAnalysis analysis;
  analysis.asset = "room.glb";
  analysis.geometries.resize(1);
  analysis.instances.resize(1);
  analysis.instances[0].mesh = "leg";
  analysis::Histogram histogram;
  histogram.values = {1};
  histogram.bins.assign(std::size_t{analysis::kHistogramBins} * analysis::kHistogramBins, 1);
  histogram.refused = "too many";
  files.start_asset(4);
  cli::write_histogram(files, analysis, 0, histogram);
  EXPECT_THAT(files.take_warnings(),
              ElementsAre(AllOf(HasSubstr("room.glb"), HasSubstr("row 4"), HasSubstr("too many"))));
  EXPECT_TRUE(fs::exists(folder.path() / "4-leg.svg"));
  EXPECT_FALSE(fs::exists(folder.path() / "4-leg.csv"));
}

}  // namespace
}  // namespace scene_analyzer
