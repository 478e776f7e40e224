#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "report/fixture.h"
#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

using analysis::Defect;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// One asset with the leg at two places and the mesh without triangles.
Fixture one_asset() {
  Fixture fixture = two_assets();
  fixture.assets.pop_back();
  return fixture;
}

TEST(DefectTable, NamesMeshKindCountPlacesAndRemedy) {
  const auto lines = lines_of(defect_table(one_asset().report(), {}));
  ASSERT_EQ(lines.size(), 9U);
  EXPECT_THAT(lines[0], AllOf(StartsWith("name "), HasSubstr(" defect "), HasSubstr(" count "),
                              HasSubstr(" first places "), HasSubstr(" what to do")));
  EXPECT_THAT(lines[1], AllOf(StartsWith("leg left (and 1 more) degenerate by shape "),
                              HasSubstr(" 1  triangle 40 "), HasSubstr("  delete them")));
  EXPECT_THAT(lines[2], AllOf(HasSubstr(" inconsistent winding "),
                              HasSubstr(" 12  triangles 0, 1, 4, 5, 8, 9, ... "), HasSubstr("orientation")));
  EXPECT_THAT(lines[3], HasSubstr(" 3  vertices 21, 22, 23 "));
  EXPECT_THAT(lines[4], HasSubstr(" 1  the whole mesh "));
  EXPECT_THAT(lines[5], testing::MatchesRegex("-+"));
  EXPECT_EQ(lines[6],
            "1 of 1 mesh (1 not analysed) with defects: 1 degenerate by shape, 12 inconsistent winding, 3 "
            "mergeable "
            "vertices, 1 far from the origin");
  EXPECT_THAT(lines[7], HasSubstr("as imported"));
}

TEST(DefectTable, SaysWhereNothingIsWrong) {
  Fixture fixture = one_asset();
  fixture.assets[0].geometries[0].defects->found.clear();
  EXPECT_EQ(defect_table(fixture.report(), {}), "no defects in 1 mesh (1 not analysed)\n");
  EXPECT_EQ(defect_table(Fixture().report(), {}), "no defects in 0 meshes\n");
  fixture.assets[0].geometries[0].defects.reset();
  EXPECT_EQ(defect_table(fixture.report(), {}), "no defects in 0 meshes (2 not analysed)\n");
}

TEST(DefectTable, ListsOnlyMeshesThatHaveSome) {
  Fixture fixture = two_assets();
  fixture.assets[0].geometries[0].defects->found.clear();
  const std::string text = defect_table(fixture.report(), {});
  EXPECT_THAT(text, AllOf(Not(HasSubstr("leg left")), HasSubstr("part.obj: say "),
                          HasSubstr("1 of 2 meshes (2 not analysed) with")));
}

TEST(DefectTable, MarksWhatItLeavesOut) {
  Fixture fixture = one_asset();
  auto& found = fixture.assets[0].geometries[0].defects->found;
  const auto row = [&](std::uint64_t count, std::vector<std::uint32_t> places) {
    found = {{Defect::kBoundaryEdges, count, std::move(places)}};
    return lines_of(defect_table(fixture.report(), {}))[1];
  };
  EXPECT_THAT(row(2, {7}), AllOf(HasSubstr("triangle 7 "), Not(HasSubstr("..."))))
      << "two edges of one triangle";
  EXPECT_THAT(row(8, {1, 2, 3, 4, 5, 6, 7, 8}), HasSubstr("triangles 1, 2, 3, 4, 5, 6, 7, 8   "));
  EXPECT_THAT(row(9, {1, 2, 3, 4, 5, 6, 7, 8}), HasSubstr("triangles 1, 2, 3, 4, 5, 6, 7, ...  "));
  EXPECT_THAT(row(1, {4'294'967'295}), HasSubstr("triangle 4294967295 "));
  const std::vector<std::uint32_t> large(8, 4'000'000'000);
  EXPECT_THAT(row(8, large), HasSubstr("triangles 4000000000, ...  "));
}

TEST(DefectTable, FitsTheTerminal) {
  Fixture fixture = two_assets();
  fixture.assets[0].instances[0].node = std::string(500, 'x') + "end";
  const UnicodeScope unicode;
  for (const std::size_t width : {80U, 100U, 121U, 122U, 200U}) {
    const std::string text = defect_table(fixture.report(), {.width = width});
    for (const std::string& line : lines_of(text)) EXPECT_LE(columns(printable(line)), width) << line;
    EXPECT_THAT(text, HasSubstr("make the faces' orientation consistent"));
    EXPECT_EQ(text.find("What to do:\n") != std::string::npos, width < 122) << width;
  }
}

TEST(DefectTable, LetsNoNameControlTheTerminal) {
  Fixture fixture = two_assets();
  fixture.assets[1].asset = "evil\x1b]0;title\x07.obj";
  const std::string text = defect_table(fixture.report(), {});
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\x07'), std::string::npos);
  EXPECT_EQ(lines_of(text).size(), 1 + 4 + 4 + 4U);
}

TEST(DefectTable, TellsHowManyLinesItLeftOut) {
  EXPECT_THAT(defect_table(two_assets().report(), {.max_rows = 3}), HasSubstr("... and 5 more lines ("));
}

}  // namespace
}  // namespace scene_analyzer::report
