// The exported file as another program reads it: Assimp.
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <span>

#include "report/glb_scene.h"

namespace scene_analyzer::report {
namespace {

using mesh::Vector3;

struct Shown {
  const aiNode* node = nullptr;
  const aiMesh* mesh = nullptr;
  aiMatrix4x4 world;
};

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, std::vector<Shown>& shown) {
  const aiMatrix4x4 world = above * node.mTransformation;
  for (const unsigned mesh : std::span(node.mMeshes, node.mNumMeshes))
    shown.push_back({&node, scene.mMeshes[mesh], world});
  for (const aiNode* child : std::span(node.mChildren, node.mNumChildren))
    collect(scene, *child, world, shown);
}

class GlbImport : public testing::Test {
 protected:
  // Every instance with a mesh, in the order of the nodes.
  std::vector<Shown> read(const std::string& file) {
    scene_ = importer_.ReadFileFromMemory(file.data(), file.size(), 0, "glb");
    if (scene_ == nullptr) throw std::runtime_error(importer_.GetErrorString());
    std::vector<Shown> shown;
    collect(*scene_, *scene_->mRootNode, aiMatrix4x4(), shown);
    return shown;
  }

  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
};

Vector3 transformed(const mesh::Matrix4& m, const float* p) {
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3];
  return result;
}

// Of the fixture's second asset: +Z up, in centimetres.
Vector3 upright(const Vector3& p) {
  return {p[0] / 100, p[2] / 100, -p[1] / 100};
}

// Corner by corner, so that the winding is compared as well.
void expect_triangles(const Shown& shown, const mesh::Scene& scene, std::size_t instance, bool is_turned) {
  const mesh::TriangleMesh& mesh = scene.meshes[scene.instances[instance].mesh];
  ASSERT_EQ(shown.mesh->mNumFaces, mesh.triangle_count());
  for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    Vector3 wanted =
        transformed(scene.instances[instance].world, &mesh.positions[3 * std::size_t{mesh.indices[corner]}]);
    if (is_turned) wanted = upright(wanted);
    const unsigned vertex = shown.mesh->mFaces[corner / 3].mIndices[corner % 3];
    const aiVector3D is = shown.world * shown.mesh->mVertices[vertex];
    EXPECT_NEAR(is.x, wanted[0], 2e-6);
    EXPECT_NEAR(is.y, wanted[1], 2e-6);
    EXPECT_NEAR(is.z, wanted[2], 2e-6);
  }
}

std::string color_of(const aiMesh& mesh) {
  const aiColor4D& first = mesh.mColors[0][0];
  for (const aiColor4D& color : std::span(mesh.mColors[0], mesh.mNumVertices)) EXPECT_EQ(color, first);
  EXPECT_EQ(first.a, 1);
  ratings::Rgb srgb;
  for (unsigned i = 0; i < 3; ++i)
    srgb[i] = first[i] <= 0.0031308f ? 12.92 * first[i] : 1.055 * std::pow(double{first[i]}, 1 / 2.4) - 0.055;
  return ratings::to_hex(srgb);
}

TEST_F(GlbImport, ShowsEveryTriangleWhereItWas) {
  const ExportedScene exported = two_exported_assets();
  const std::vector<Shown> shown = read(exported.file());
  ASSERT_EQ(shown.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) expect_triangles(shown[i], exported.scenes()[0], i, false);
  expect_triangles(shown[3], exported.scenes()[1], 0, true);
  EXPECT_EQ(shown[0].mesh->mNumFaces, 4u);
  EXPECT_EQ(shown[3].node->mName.C_Str(), std::string("plate"));
  EXPECT_EQ(shown[3].node->mParent->mName.C_Str(), std::string("part.fbx"));
}

TEST_F(GlbImport, ShowsEveryColor) {
  const ExportedScene exported = two_exported_assets();
  const std::vector<Shown> shown = read(exported.file());
  ASSERT_EQ(shown.size(), 4u);
  const char* wanted[] = {"#ff0000", "#00ff00", "#808080", "#4d33e6"};
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(shown[i].mesh->HasVertexColors(0));
    EXPECT_EQ(color_of(*shown[i].mesh), wanted[i]);
    EXPECT_EQ(shown[i].mesh->mMaterialIndex, 0u);
  }
  EXPECT_EQ(std::string(scene_->mMaterials[0]->GetName().C_Str()), "rating");
}

TEST_F(GlbImport, ShowsManyColorsOfMeshesOfManySizes) {
  ExportedScene exported;
  exported.add_asset("many.glb");
  for (std::uint32_t i = 0; i < 60; ++i)
    exported.add_instance(exported.add_mesh("mesh", many_positions(3 + i * 7 % 50), {0, 1, 2, 2, 1, i % 3}),
                          "node", mesh::kIdentity4, ratings::Rgb{i % 5 / 5.0, i % 3 / 3.0, i % 2 / 2.0});
  const std::vector<Shown> shown = read(exported.file());
  ASSERT_EQ(shown.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    expect_triangles(shown[i], exported.scenes()[0], i, false);
    EXPECT_EQ(color_of(*shown[i].mesh), ratings::to_hex(*exported.colors()[i]));
  }
}

TEST_F(GlbImport, MirroredShearKeepsItsPlaceAndWinding) {
  ExportedScene exported;
  exported.add_asset("mirror.glb");
  const std::uint32_t mesh = exported.add_mesh("mesh", tetrahedron_positions(), tetrahedron_indices());
  mesh::Matrix4 world = kShear;
  world[10] = -1;
  exported.add_instance(mesh, "mirrored shear", world);
  const std::vector<Shown> shown = read(exported.file());
  ASSERT_EQ(shown.size(), 1u);
  expect_triangles(shown[0], exported.scenes()[0], 0, false);
  EXPECT_LT(shown[0].world.Determinant(), 0) << "the node says that triangles are turned around";
}

TEST_F(GlbImport, ShowsWhatIsLeftOfDamage) {
  ExportedScene exported;
  exported.add_asset("damaged.glb");
  std::vector<float> positions = many_positions(70000);
  positions[3 * 5] = std::nanf("");
  const std::uint32_t mesh = exported.add_mesh("mesh", positions, {0, 1, 2, 3, 4, 5, 69999, 6, 7});
  exported.add_instance(mesh, "node");
  exported.add_instance(exported.add_mesh("empty", {}, {}), "nothing");
  const std::vector<Shown> shown = read(exported.file());
  ASSERT_EQ(shown.size(), 1u);
  ASSERT_EQ(shown[0].mesh->mNumFaces, 2u);
  EXPECT_EQ(shown[0].mesh->mFaces[1].mIndices[0], 69999u);
  EXPECT_EQ(shown[0].mesh->mVertices[69999].x, positions[3 * 69999]);
}

}  // namespace
}  // namespace scene_analyzer::report
