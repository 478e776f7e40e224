// What an export leaves out, changes or refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "report/glb_scene.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::string error_of(const ExportedScene& scene) {
  try {
    (void)scene.file();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(GlbLimits, LeavesOutTrianglesThatAreNotFinite) {
  std::vector<float> positions = tetrahedron_positions();
  positions.insert(positions.end(), {kNan, 0, 0, 0, kInfinity, 0, 5, 5, -kInfinity});
  const ParsedGlb file(one_mesh(positions, {0, 1, 2, 0, 1, 4, 5, 2, 3, 1, 2, 3, 6, 6, 6}).file());
  EXPECT_EQ(file.indices(file.primitive_of(0)["indices"]), (std::vector<std::uint32_t>{0, 1, 2, 1, 2, 3}));
  const std::vector<Position> stored = file.positions(file.position_accessor(0));
  ASSERT_EQ(stored.size(), 7u);
  EXPECT_EQ(stored[3], (Position{0, 0, -3.7f}));
  // What is in no triangle does not widen the bounds either.
  const ordered_json& accessor = file.json["accessors"][file.position_accessor(0)];
  EXPECT_EQ(accessor["min"], (std::array<float, 3>{0, 0, -3.7f}));
  EXPECT_EQ(accessor["max"], (std::array<float, 3>{1.1f, 2.3f, 0}));
  EXPECT_EQ(file.instance(0)["extras"]["left_out_triangles"], 3);
  EXPECT_THAT(file.instance(0)["extras"]["left_out_because"].get<std::string>(), HasSubstr("corner"));
}

TEST(GlbLimits, AMeshOfNothingIsANodeOnly) {
  ExportedScene scene = one_mesh({}, {});
  scene.add_instance(scene.add_mesh("points", many_positions(4), {}), "points");
  scene.add_instance(scene.add_mesh("lost", {kNan, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}), "lost");
  const ParsedGlb file(scene.file());
  ASSERT_EQ(file.json["nodes"].size(), 4u);
  const SceneReport report = scene.report();
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_FALSE(file.instance(row).contains("mesh")) << row;
    EXPECT_EQ(file.instance(row)["extras"]["index"], row);
  }
  EXPECT_FALSE(file.instance(1)["extras"].contains("left_out_triangles"));
  EXPECT_EQ(file.instance(2)["extras"]["left_out_triangles"], 1);
  // glTF has no empty lists.
  for (const char* key : {"meshes", "materials", "accessors", "bufferViews", "buffers"})
    EXPECT_FALSE(file.json.contains(key)) << key;
  EXPECT_TRUE(file.binary.empty());
}

TEST(GlbLimits, AnAssetOfNothingAndNoAssetAreFiles) {
  ExportedScene scene;
  const ParsedGlb nothing(scene.file());
  EXPECT_FALSE(nothing.json.contains("nodes"));
  EXPECT_FALSE(nothing.json["scenes"][0].contains("nodes"));
  EXPECT_EQ(nothing.json["scenes"][0]["extras"]["scene"]["mesh_count"], 0);
  scene.add_asset("empty.glb");
  const ParsedGlb empty(scene.file());
  EXPECT_EQ(empty.json["nodes"].size(), 1u);
  EXPECT_FALSE(empty.json["nodes"][0].contains("children"));
}

TEST(GlbLimits, AppliesShearToPositions) {
  ExportedScene scene = one_mesh(tetrahedron_positions(), tetrahedron_indices(), kShear);
  mesh::Matrix4 elsewhere = kShear;
  elsewhere[3] = 40;
  scene.add_instance(0, "same shear", elsewhere);
  scene.add_instance(0, "as it is");
  const ParsedGlb file(scene.file());
  EXPECT_THAT(file.positions(file.position_accessor(0)),
              ElementsAre(Position{0, 0, 0}, Position{1.1f, 0, 0}, Position{2.3f / 2, 2.3f, 0},
                          Position{0, 0, -3.7f}));
  EXPECT_EQ(file.instance(0)["translation"], (ordered_json{1.0, 2.0, 3.0}));
  EXPECT_EQ(file.instance(1)["translation"], (ordered_json{40.0, 2.0, 3.0}));
  for (const char* key : {"rotation", "scale", "matrix"}) EXPECT_FALSE(file.instance(0).contains(key)) << key;
  EXPECT_EQ(file.instance(0)["mesh"], file.instance(1)["mesh"]);
  EXPECT_NE(file.position_accessor(0), file.position_accessor(2));
  EXPECT_EQ(file.primitive_of(0)["indices"], file.primitive_of(2)["indices"]);
  EXPECT_EQ(file.binary.size(), 2u * 4 * 12 + 12 * 2 + 4 * 8);
}

TEST(GlbLimits, AShearThatOverflowsHasIndicesOfItsOwn) {
  ExportedScene scene = one_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1e38f, 0}, {0, 1, 2, 0, 1, 3});
  mesh::Matrix4 world = kShear;
  world[1] = 10;
  scene.add_instance(0, "overflows", world);
  const ParsedGlb file(scene.file());
  EXPECT_EQ(file.indices(file.primitive_of(0)["indices"]).size(), 6u);
  EXPECT_EQ(file.indices(file.primitive_of(1)["indices"]), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_FALSE(file.instance(0)["extras"].contains("left_out_triangles"));
  EXPECT_EQ(file.instance(1)["extras"]["left_out_triangles"], 1);
}

TEST(GlbLimits, AMatrixBeyondFloatsHidesItsInstance) {
  ExportedScene scene = one_mesh(tetrahedron_positions(), tetrahedron_indices());
  for (const double element : {std::numeric_limits<double>::quiet_NaN(), 1e39}) {
    mesh::Matrix4 world = mesh::kIdentity4;
    world[5] = element;
    scene.add_instance(0, "lost", world);
  }
  const ParsedGlb file(scene.file());
  EXPECT_TRUE(file.instance(0).contains("mesh"));
  for (const std::size_t row : {1u, 2u}) {
    EXPECT_FALSE(file.instance(row).contains("mesh"));
    EXPECT_EQ(file.instance(row)["extras"]["left_out_triangles"], 4);
    EXPECT_THAT(file.instance(row)["extras"]["left_out_because"].get<std::string>(), HasSubstr("matrix"));
  }
}

TEST(GlbLimits, RefusesWhatIsBeyondFourGibibytes) {
  // Planned only: 8 MiB for each of 601 colours and 12 of positions.
  ExportedScene scene = one_mesh(std::vector<float>(3u << 20), {0, 1, 2});
  for (int i = 0; i < 600; ++i)
    scene.add_instance(0, "node", mesh::kIdentity4, ratings::Rgb{i % 256 / 255.0, i / 256 / 255.0, 0});
  EXPECT_THAT(error_of(scene),
              ::testing::AllOf(HasSubstr("4.8 GiB"), HasSubstr("4 GiB"), HasSubstr("fewer assets")));
}

TEST(GlbLimits, RefusesAnAssetThatChangedSinceItsAnalysis) {
  ExportedScene scene = two_exported_assets();
  ++scene.analysis().geometries[0].source_triangles;
  EXPECT_THAT(error_of(scene), ::testing::StartsWith("models/part.fbx: the file changed"));
  scene = two_exported_assets();
  scene.scene().instances.push_back(scene.scene().instances[0]);
  EXPECT_THAT(error_of(scene), ::testing::StartsWith("models/part.fbx: the file changed"));
}

}  // namespace
}  // namespace scene_analyzer::report
