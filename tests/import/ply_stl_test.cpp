// Formats that count: files that are shorter than they say are refused, whole ones pass.
#include <gmock/gmock.h>

#include "import/model_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using testing::HasSubstr;

TEST(ImportStl, BinaryAlsoWhenItStartsWithSolid) {
  const TempFolder folder;
  for (const char* header : {"made for a test", "solid but binary"}) {
    const mesh::Scene scene = import_asset(folder.write("a.stl", binary_stl(5, header)));
    EXPECT_EQ(scene.meshes.at(0).triangle_count(), 5u);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(ImportStl, SizesThatDoNotMatchAreRefused) {
  const TempFolder folder;
  const std::string whole = binary_stl(5);
  EXPECT_THAT(refusal(folder.write("a.stl", whole.substr(0, whole.size() - 1))),
              HasSubstr("of 5 triangles takes 334 bytes and the file has 333"));
  EXPECT_THAT(refusal(folder.write("a.stl", binary_stl(5, "solid but binary").substr(0, 200))),
              HasSubstr("the file has 200"));
  EXPECT_THAT(refusal(folder.write("a.stl", whole + "x")), HasSubstr("the file has 335"));
  EXPECT_THAT(refusal(folder.write("a.stl", whole.substr(0, 40))), HasSubstr("no whole STL"));
  EXPECT_THAT(refusal(folder.write("a.stl", binary_stl(0))), HasSubstr("0 triangles"));
}

TEST(ImportStl, TextWithoutAnEndIsAWarning) {
  const TempFolder folder;
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_TRUE(mentions(import_asset(folder.write("a.stl", "solid a\n" + facet)).warnings, "endsolid"));
  EXPECT_TRUE(import_asset(folder.write("a.stl", "solid a\n" + facet + "endsolid a\n")).warnings.empty());
}

TEST(ImportPly, EveryTruncationIsRefused) {
  const TempFolder folder;
  const std::string whole = binary_ply(2);
  EXPECT_EQ(import_asset(folder.write("a.ply", whole)).meshes.at(0).triangle_count(), 2u);
  for (std::size_t size = 1; size < whole.size(); size += 3)
    EXPECT_NE(refusal(folder.write("a.ply", whole.substr(0, size))), "") << size;
  EXPECT_THAT(refusal(folder.write("a.ply", whole.substr(0, whole.size() - 1))),
              HasSubstr("counts 2 of \"face\" but the data ends after 1"));
}

TEST(ImportPly, HugeCountsCostNothing) {
  const TempFolder folder;
  std::string lying = binary_ply(1);
  lying.replace(lying.find("face 1"), 6, "face 4000000000");
  EXPECT_THAT(refusal(folder.write("a.ply", lying)), HasSubstr("counts 4000000000 of \"face\""));
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\nproperty float x\nend_header\n0\n";
  EXPECT_THAT(refusal(folder.write("a.ply", text)), HasSubstr("\"vertex\""));
}

TEST(ImportPly, AShortTextFileIsRefused) {
  const TempFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(refusal(folder.write("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), "");
}

TEST(ImportPly, AnIndexBeyondTheVerticesIsRefused) {
  const TempFolder folder;
  std::string bytes = binary_ply(1);
  bytes[bytes.size() - 4] = 9;
  EXPECT_THAT(refusal(folder.write("a.ply", bytes)), HasSubstr("vertex 9 of 3"));
}

TEST(ImportOff, AShortFileIsRefused) {
  const TempFolder folder;
  EXPECT_NE(refusal(folder.write("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n")), "");
}

}  // namespace
}  // namespace scene_analyzer::import
