// What a scene holds: polygons, order of instances, world matrices, names.
#include <gmock/gmock.h>

#include "import/gltf_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

mesh::Scene scene_of(const std::string& name, const std::string& contents) {
  const TempFolder folder;
  return import_asset(folder.write(name, contents));
}

std::vector<std::string> node_names(const mesh::Scene& scene) {
  std::vector<std::string> names;
  for (const mesh::Instance& instance : scene.instances) names.push_back(instance.node);
  return names;
}

TEST(ImportScene, PolygonsAreCutIntoTriangles) {
  const mesh::Scene scene = scene_of(
      "a.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2 3 5\nf 1 2 3\nl 1 2\np 1\n");
  std::uint64_t triangles = 0, skipped = 0;
  for (const mesh::TriangleMesh& mesh : scene.meshes) {
    triangles += mesh.triangle_count();
    skipped += mesh.skipped_primitives;
  }
  EXPECT_EQ(triangles, 3u + 2u + 1u);
  EXPECT_EQ(skipped, 2u);
}

TEST(ImportScene, AConcavePolygonKeepsItsArea) {
  // An arrow head: a fan from the first corner would leave it.
  const mesh::Scene scene = scene_of("a.obj", "v 0 0 0\nv 4 2 0\nv 0 4 0\nv 1 2 0\nf 1 2 3 4\n");
  const mesh::TriangleMesh& mesh = scene.meshes.at(0);
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const float *a = &mesh.positions[3 * mesh.indices[i]], *b = &mesh.positions[3 * mesh.indices[i + 1]],
                *c = &mesh.positions[3 * mesh.indices[i + 2]];
    area += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  EXPECT_DOUBLE_EQ(area, 6);
}

TEST(ImportScene, TextureCoordinatesComeInPairs) {
  const mesh::Scene scene =
      scene_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  EXPECT_THAT(scene.meshes.at(0).texture_coordinates, ElementsAre(0.25f, 0.5f, 1, 0, 0, 1));
}

TEST(ImportScene, NonFiniteCoordinatesArePassedOn) {
  const mesh::Scene scene = scene_of("a.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 1u);
}

TEST(ImportScene, DepthFirstANodesMeshesBeforeItsChildren) {
  QuadGltf quad;
  quad.root["scenes"][0]["nodes"] = {0, 4};
  quad.root["nodes"] = {{{"name", "a"}, {"mesh", 0}, {"children", {1, 3}}},
                        {{"name", "a1"}, {"children", {2}}},
                        {{"name", "a11"}, {"mesh", 0}},
                        {{"name", "a2"}, {"mesh", 0}},
                        {{"name", "b"}, {"mesh", 0}}};
  EXPECT_THAT(node_names(scene_of("a.gltf", quad.text())), ElementsAre("a", "a11", "a2", "b"));
}

TEST(ImportScene, EveryPrimitiveIsAnInstanceAndInstancesShareAMesh) {
  QuadGltf quad;
  json primitive = quad.root["meshes"][0]["primitives"][0];
  primitive["mode"] = 6;
  quad.root["meshes"][0]["primitives"].push_back(primitive);
  quad.root["scenes"][0]["nodes"] = {0, 1};
  quad.root["nodes"] = {{{"name", "a"}, {"mesh", 0}}, {{"name", "b"}, {"mesh", 0}}};
  const mesh::Scene scene = scene_of("a.gltf", quad.text());
  EXPECT_THAT(node_names(scene), ElementsAre("a", "a", "b", "b"));
  EXPECT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
  EXPECT_NE(scene.instances[0].mesh, scene.instances[1].mesh);
}

TEST(ImportScene, WorldMatricesAreProductsInDouble) {
  QuadGltf quad;
  // Columns first, as glTF writes them: mirrored and non-uniform below moved.
  quad.root["nodes"] = {{{"translation", {10, 20, 30}}, {"children", {1}}},
                        {{"mesh", 0}, {"matrix", {-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 5, 0, 1, 2, 3, 1}}}};
  const mesh::Scene scene = scene_of("a.gltf", quad.text());
  EXPECT_EQ(scene.instances.at(0).world, (mesh::Matrix4{-2, 0, 0, 11, 0, 3, 0, 22, 0, 0, 5, 33, 0, 0, 0, 1}));

  // 1e8 + 1 needs more than a float.
  quad.root["nodes"] = {{{"translation", {1e8, 0, 0}}, {"children", {1}}},
                        {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  EXPECT_EQ(scene_of("b.gltf", quad.text()).instances.at(0).world[3], 100000001.0);
}

TEST(ImportScene, DeepHierarchies) {
  constexpr int kDepth = 5000;
  QuadGltf quad;
  quad.root["nodes"] = json::array();
  for (int i = 0; i < kDepth; ++i)
    quad.root["nodes"].push_back({{"translation", {1, 0, 0}}, {"children", {i + 1}}});
  quad.root["nodes"].push_back({{"name", "leaf"}, {"mesh", 0}});
  const mesh::Scene scene = scene_of("deep.gltf", quad.text());
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].node, "leaf");
  EXPECT_EQ(scene.instances[0].world[3], kDepth);
}

TEST(ImportScene, AThousandNodesShareAMesh) {
  QuadGltf quad;
  quad.root["nodes"] = json::array();
  quad.root["scenes"][0]["nodes"] = json::array();
  for (int i = 0; i < 1000; ++i) {
    quad.root["scenes"][0]["nodes"].push_back(i);
    quad.root["nodes"].push_back({{"mesh", 0}, {"translation", {i, 0, 0}}});
  }
  const mesh::Scene scene = scene_of("a.gltf", quad.text());
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 1000u);
  EXPECT_EQ(scene.instances[999].world[3], 999);
}

TEST(ImportScene, HostileNamesAreCleaned) {
  QuadGltf quad;
  quad.root["nodes"][0]["name"] = std::string("a\x1b[31m\nb") + std::string(5000, 'x');
  quad.root["meshes"][0]["name"] = "../../etc/passwd";
  const mesh::Scene scene = scene_of("a.gltf", quad.text());
  EXPECT_THAT(scene.instances.at(0).node, testing::StartsWith("a[31mbxx"));
  EXPECT_LE(scene.instances.at(0).node.size(), 1024u);
  EXPECT_EQ(scene.meshes.at(0).name, "../../etc/passwd");
}

TEST(ImportScene, AnAssetWithoutTrianglesIsAScene) {
  EXPECT_EQ(scene_of("a.obj", "# nothing here but a comment of some length\n").instances.size(), 0u);
  const mesh::Scene points =
      scene_of("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
               "property float z\nend_header\n0 0 0\n1 1 1\n");
  EXPECT_EQ(points.instances.size(), 1u);
  EXPECT_EQ(points.meshes.at(0).triangle_count(), 0u);
}

TEST(ImportScene, DefaultMaterialHasNoColour) {
  const mesh::Scene scene = scene_of("a.stl",
                                     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                     "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
  EXPECT_FALSE(scene.materials.at(scene.meshes.at(0).material).base_color);
  EXPECT_FALSE(scene.unit_scale);
  EXPECT_FALSE(scene.up_axis);
}

}  // namespace
}  // namespace scene_analyzer::import
