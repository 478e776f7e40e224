#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include "report/document.h"
#include "report/glb_scene.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;
using ::testing::ElementsAre;

// The values that a report prints: NaN is null there and broken UTF-8 replaced.
ordered_json printed(const ordered_json& value) {
  return ordered_json::parse(print(value));
}

TEST(Glb, DescribesItself) {
  const ParsedGlb file(two_exported_assets().file());
  EXPECT_EQ(file.json["asset"], (ordered_json{{"version", "2.0"}, {"generator", "Scene Analyzer 1.2.3"}}));
  EXPECT_EQ(file.json["scene"], 0);
  ASSERT_EQ(file.json["materials"].size(), 1u);
  const ordered_json& material = file.json["materials"][0];
  EXPECT_EQ(material["name"], "rating");
  EXPECT_EQ(material["doubleSided"], true);
  EXPECT_EQ(material["pbrMetallicRoughness"], ordered_json::parse(R"({"baseColorFactor": [1, 1, 1, 1],
                                               "metallicFactor": 0, "roughnessFactor": 1})"));
}

TEST(Glb, ChunksEndOnMultiplesOfFour) {
  for (std::size_t length = 1; length <= 4; ++length) {
    ExportedScene scene = one_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});  // 6 bytes of indices
    scene.scene().meshes[0].name = std::string(length, 'n');
    EXPECT_EQ(ParsedGlb(scene.file()).json["meshes"][0]["name"], std::string(length, 'n'));
  }
}

TEST(Glb, HasANodePerAssetAndPerInstance) {
  const ParsedGlb file(two_exported_assets().file());
  const ordered_json& nodes = file.json["nodes"];
  ASSERT_EQ(nodes.size(), 6u);
  EXPECT_EQ(file.json["scenes"][0]["nodes"], (ordered_json{0, 1}));
  EXPECT_EQ(nodes[0]["name"], "room.glb");
  EXPECT_EQ(nodes[0]["children"], (ordered_json{2, 3, 4}));
  EXPECT_EQ(nodes[1]["name"], "part.fbx");
  EXPECT_EQ(nodes[1]["children"], (ordered_json{5}));
  const std::vector<std::string> names = {nodes[2]["name"], nodes[3]["name"], nodes[4]["name"],
                                          nodes[5]["name"]};
  EXPECT_THAT(names, ElementsAre("left", "right", "square", "plate"));
}

TEST(Glb, SetsAssetsUprightThatSayHow) {
  ExportedScene scene = two_exported_assets();
  const ParsedGlb file(scene.file());
  for (const char* key : {"translation", "rotation", "scale", "matrix"})
    EXPECT_FALSE(file.json["nodes"][0].contains(key)) << key;
  const ordered_json& part = file.json["nodes"][1];
  EXPECT_EQ(part["scale"], (ordered_json{0.01, 0.01, 0.01}));
  ASSERT_EQ(part["rotation"].size(), 4u);
  EXPECT_DOUBLE_EQ(part["rotation"][0], -std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(part["rotation"][3], std::sqrt(0.5));
  EXPECT_FALSE(part.contains("translation"));
}

TEST(Glb, KeepsTheReportInExtras) {
  const ExportedScene scene = two_exported_assets();
  const SceneReport report = scene.report();
  const ParsedGlb file(scene.file());
  const ordered_json head = printed(document_head(report));
  EXPECT_EQ(head["tool"]["version"], "1.2.3");
  EXPECT_EQ(file.json["scenes"][0]["extras"], head);
  EXPECT_EQ(file.json["nodes"][0]["extras"], head["assets"][0]);
  EXPECT_EQ(file.json["nodes"][1]["extras"], head["assets"][1]);
  ASSERT_EQ(report.rating.meshes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(file.instance(i)["extras"], printed(mesh_row(report, i)));
    EXPECT_EQ(file.instance(i)["extras"]["ratings"]["planar_group_variation"],
              1.0 / (2.0 + static_cast<double>(i)));
  }
}

TEST(Glb, StoresSharedGeometryOnce) {
  ExportedScene scene;
  scene.add_asset("many.glb");
  const std::uint32_t mesh = scene.add_mesh("mesh", tetrahedron_positions(), tetrahedron_indices());
  mesh::Matrix4 world = mesh::kIdentity4;
  for (int i = 0; i < 10; ++i) {
    world[3] = i;
    scene.add_instance(mesh, "node", world, i % 2 == 0 ? kRed : kGreen);
  }
  const ParsedGlb file(scene.file());
  EXPECT_EQ(file.json["accessors"].size(), 4u) << "positions, indices, two colours";
  EXPECT_EQ(file.json["meshes"].size(), 2u);
  EXPECT_EQ(file.binary.size(), 4u * 12 + 12 * 2 + 2 * 4 * 8);
  for (std::size_t row = 0; row < 10; ++row) EXPECT_EQ(file.instance(row)["mesh"], row % 2);
  EXPECT_EQ(file.position_accessor(0), file.position_accessor(1));
  EXPECT_EQ(file.primitive_of(0)["indices"], file.primitive_of(1)["indices"]);
}

TEST(Glb, MeshesOfOneColorShareItsBytes) {
  ExportedScene scene;
  scene.add_asset("many.glb");
  for (const std::size_t vertices : {3u, 50u, 7u, 50u})
    scene.add_instance(scene.add_mesh("mesh", many_positions(vertices), {0, 1, 2}), "node", mesh::kIdentity4,
                       kRed);
  const ParsedGlb file(scene.file());
  std::set<std::size_t> views, counts;
  for (std::size_t row = 0; row < 4; ++row) {
    const std::size_t colors = file.primitive_of(row)["attributes"]["COLOR_0"];
    views.insert(file.json["accessors"][colors]["bufferView"].get<std::size_t>());
    counts.insert(file.json["accessors"][colors]["count"].get<std::size_t>());
  }
  EXPECT_THAT(counts, ElementsAre(3, 7, 50));
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(file.json["bufferViews"][*views.begin()]["byteLength"], 50 * 8);
  EXPECT_EQ(file.json["bufferViews"][*views.begin()]["byteStride"], 8);
}

TEST(Glb, ColorsComeBackToTheLastBit) {
  ExportedScene scene;
  scene.add_asset("colors.glb");
  const std::uint32_t mesh = scene.add_mesh("mesh", tetrahedron_positions(), tetrahedron_indices());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> channel(-0.1, 1.1);
  for (int i = 0; i < 256; ++i)
    scene.add_instance(mesh, "every byte", mesh::kIdentity4,
                       ratings::Rgb{i / 255.0, (255 - i) / 255.0, i * 7 % 256 / 255.0});
  for (int i = 0; i < 1000; ++i)
    scene.add_instance(mesh, "between bytes", mesh::kIdentity4,
                       ratings::Rgb{channel(random), channel(random), (i % 255 + 0.5) / 255});
  const ParsedGlb file(scene.file());
  ASSERT_EQ(scene.colors().size(), 1256u);
  for (std::size_t i = 0; i < 1256; ++i)
    EXPECT_EQ(file.color_of(i), ratings::to_hex(*scene.colors()[i])) << i;
}

TEST(Glb, IsGreyWithoutAValue) {
  const ParsedGlb file(two_exported_assets().file());
  EXPECT_EQ(file.color_of(0), "#ff0000");
  EXPECT_EQ(file.color_of(1), "#00ff00");
  EXPECT_EQ(file.color_of(2), "#808080");
  EXPECT_EQ(file.color_of(3), "#4d33e6");
}

TEST(Glb, KeepsPositionsAndIndicesAsTheyAre) {
  const ParsedGlb file(two_exported_assets().file());
  EXPECT_THAT(
      file.positions(file.position_accessor(0)),
      ElementsAre(Position{0, 0, 0}, Position{1.1f, 0, 0}, Position{0, 2.3f, 0}, Position{0, 0, -3.7f}));
  EXPECT_EQ(file.indices(file.primitive_of(0)["indices"]), tetrahedron_indices());
}

TEST(Glb, AssetsDoNotShareMeshesOfOneNumber) {
  ExportedScene scene = one_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  scene.add_asset("other.glb");
  scene.add_instance(scene.add_mesh("mesh", {0, 0, 0, 2, 0, 0, 0, 2, 0}, {2, 1, 0}), "node");
  const ParsedGlb file(scene.file());
  EXPECT_EQ(file.positions(file.position_accessor(0))[1], (Position{1, 0, 0}));
  EXPECT_EQ(file.positions(file.position_accessor(1))[1], (Position{2, 0, 0}));
  EXPECT_EQ(file.indices(file.primitive_of(1)["indices"]), (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(Glb, IndicesTakeTheWidthTheyNeed) {
  for (const std::uint32_t vertices : {65535u, 65536u}) {
    const std::vector<std::uint32_t> indices = {0, vertices - 1, 7, 7, 0, 1, 2, 3, 4};
    const ParsedGlb file(one_mesh(many_positions(vertices), indices).file());
    const std::size_t accessor = file.primitive_of(0)["indices"];
    EXPECT_EQ(file.json["accessors"][accessor]["componentType"], vertices == 65535 ? 5123 : 5125);
    EXPECT_EQ(file.indices(accessor), indices);
  }
}

TEST(Glb, NamesAreThoseOfTheTableInValidUtf8) {
  ExportedScene scene;
  scene.add_asset("caf\xe9/t\xfcr.glb");
  const auto mesh = [&](const std::string& name) {
    return scene.add_mesh(name, tetrahedron_positions(), tetrahedron_indices());
  };
  scene.add_instance(mesh("mesh"), "say \"hi\"\n\xff\xc3\xa4");
  scene.add_instance(mesh("b\xe4r"), "");
  scene.add_instance(mesh(""), "");
  const ParsedGlb file(scene.file());
  EXPECT_EQ(file.json["nodes"][0]["name"], "t\xef\xbf\xbdr.glb");
  EXPECT_EQ(file.instance(0)["name"], "say \"hi\"\n\xef\xbf\xbd\xc3\xa4");
  EXPECT_EQ(file.instance(1)["name"], "b\xef\xbf\xbdr");
  EXPECT_EQ(file.json["meshes"][1]["name"], "b\xef\xbf\xbdr");
  EXPECT_FALSE(file.instance(2).contains("name"));
}

TEST(Glb, IsDeterministic) {
  EXPECT_EQ(two_exported_assets().file(), two_exported_assets().file());
}

TEST(Glb, OfManyInstancesIsWhole) {
  ExportedScene scene;
  scene.add_asset("many.glb");
  for (int i = 0; i < 100; ++i) scene.add_mesh("mesh", tetrahedron_positions(), tetrahedron_indices());
  mesh::Matrix4 world = kShear;
  for (int i = 0; i < 5'000; ++i) {
    world[1] = i % 1000;  // each of the meshes in ten shapes
    scene.add_instance(static_cast<std::uint32_t>(i % 100), "node", world, ratings::color(i % 1000 / 1000.0));
  }
  const ParsedGlb parsed(scene.file());
  EXPECT_EQ(parsed.json["nodes"].size(), 5'001u);
  EXPECT_EQ(parsed.json["meshes"].size(), 1000u);
}

}  // namespace
}  // namespace scene_analyzer::report
