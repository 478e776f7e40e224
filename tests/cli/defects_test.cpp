// `scene-analyzer analyze --defects` as a user runs it, on files whose defects are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Counts = std::map<std::string, int>;

// PLY keeps vertices as they are: shared ones stay shared, loose ones stay.
template <typename Mesh>
std::string ply_of(const Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size() / 3, mesh.indices.size() / 3);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    text += fmt::format("{} {} {}\n", mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    text += fmt::format("3 {} {} {}\n", mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  return text;
}

class DefectsProgramTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }

  json defects_of(const std::string& asset) {
    const ProgramResult result = analyze({asset, "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out)["meshes"][0]["defects"];
  }

  // Those that are not 0.
  Counts counts_of(const std::string& asset) {
    const json defects = defects_of(asset);
    Counts counts;
    for (const auto& [kind, count] : defects["counts"].items())
      if (count > 0) counts[kind] = count;
    return counts;
  }

  TemporaryFolder folder_;
};

TEST_F(DefectsProgramTest, AGoodMeshHasNone) {
  folder_.write("cube.ply", ply_of(cli::cube()));
  const ProgramResult result = analyze({"cube.ply", "--defects"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("\n\nno defects in 1 mesh\n"));
  EXPECT_THAT(analyze({"cube.ply"}).out, Not(HasSubstr("defects")));
  EXPECT_THAT(counts_of("cube.ply"), IsEmpty());
}

TEST_F(DefectsProgramTest, TheTableNamesKindCountPlaceAndRemedy) {
  auto cube = cli::cube();
  std::swap(cube.indices[3 * 5], cube.indices[3 * 5 + 1]);
  folder_.write("cube.ply", ply_of(cube));
  folder_.write("good.ply", ply_of(cli::prism(10, 1, 0.03, 0.12)));
  const ProgramResult result = analyze({"cube.ply", "good.ply", "--defects"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(complaints(result), IsEmpty());
  EXPECT_THAT(result.out, AllOf(HasSubstr(" inconsistent winding          3  triangles "),
                                HasSubstr("make the faces' orientation consistent"),
                                HasSubstr("1 of 2 meshes with defects: 3 inconsistent winding\n")));
  EXPECT_EQ(analyze({"cube.ply", "good.ply", "--defects"}).out, result.out) << "from the analysis files";
}

TEST_F(DefectsProgramTest, EveryKindIsFoundInAFile) {
  auto cube = cli::cube();
  const auto vertex = [&](float x, float y, float z) {
    cube.positions.insert(cube.positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(cube.positions.size() / 3 - 1);
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    cube.indices.insert(cube.indices.end(), {a, b, c});
  };
  const std::uint32_t twin = vertex(cube.positions[0], cube.positions[1], cube.positions[2]);  // 8
  vertex(7, 7, 7);                                                                             // 9, loose
  triangle(0, twin, 1);  // 12: one place twice
  const std::uint32_t a = vertex(20, 0, 0), b = vertex(21, 0, 0), c = vertex(22, 0, 0);
  triangle(a, b, c);                                            // 13: a line
  triangle(cube.indices[2], cube.indices[0], cube.indices[1]);  // 14: a copy of 0
  triangle(a, b, vertex(20, 1, 0));                             // 15: alone
  folder_.write("broken.ply", ply_of(cube));
  EXPECT_EQ(counts_of("broken.ply"), (Counts{{"degenerate_by_index", 1},
                                             {"degenerate_by_shape", 1},
                                             {"duplicate_triangles", 1},
                                             {"non_manifold_edges", 3},
                                             {"boundary_edges", 3},
                                             {"isolated_triangles", 1},
                                             {"unreferenced_vertices", 1},
                                             {"mergeable_vertices", 1}}));
  const json places = defects_of("broken.ply")["places"];
  EXPECT_EQ(places["degenerate_by_index"], json({12}));
  EXPECT_EQ(places["degenerate_by_shape"], json({13}));
  EXPECT_EQ(places["duplicate_triangles"], json({14}));
  EXPECT_EQ(places["boundary_edges"], json({15}));
  EXPECT_EQ(places["isolated_triangles"], json({15}));
  EXPECT_EQ(places["unreferenced_vertices"], json({9}));
  EXPECT_EQ(places["mergeable_vertices"], json({8}));
  EXPECT_EQ(places["inconsistent_winding"], json::array());
}

TEST_F(DefectsProgramTest, MergeableVerticesFollowTheTolerance) {
  auto pair = cli::flat_grid(1);
  pair.positions.insert(pair.positions.end(),
                        {pair.positions[0] + 1e-4F, pair.positions[1], pair.positions[2]});
  folder_.write("pair.ply", ply_of(pair));
  EXPECT_EQ(defects_of("pair.ply")["counts"]["mergeable_vertices"], 0);
  const ProgramResult welded = analyze({"pair.ply", "--weld-tolerance", "1e-3", "--json", "-"});
  EXPECT_EQ(json::parse(welded.out)["meshes"][0]["defects"]["counts"]["mergeable_vertices"], 1);
}

TEST_F(DefectsProgramTest, AMeshFarAwayOrWithoutAreaSaysSo) {
  auto far = cli::cube();
  for (std::size_t i = 0; i < far.positions.size(); i += 3) far.positions[i] = 100 * far.positions[i] + 1e8F;
  folder_.write("far.ply", ply_of(far));
  EXPECT_EQ(counts_of("far.ply")["far_from_origin"], 1);
  folder_.write(
      "line.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  EXPECT_EQ(counts_of("line.ply"), (Counts{{"degenerate_by_shape", 1}, {"zero_area", 1}}));
  EXPECT_THAT(analyze({"line.ply", "--defects"}).out, HasSubstr("  the whole mesh "));
}

TEST_F(DefectsProgramTest, TheHelpSaysWhatIsFoundAndWhereThePlacesAre) {
  const std::string help = analyze({"--help"}).out;
  EXPECT_THAT(help, AllOf(HasSubstr("--defects"), HasSubstr("counted from 0")));
}

}  // namespace
}  // namespace scene_analyzer
