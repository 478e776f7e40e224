// One asset for the window: analysed, loaded again with textures, its planar groups measured.
#include "viewer/reviewed_asset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/error.h"
#include "import/gltf_builder.h"
#include "scene_render/scene_model_builder.h"
#include "support/gpu_test.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Two triangles in one plane, and one by itself.
constexpr const char* kFold =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\no fold\nf 1 2 3\nf 1 3 4\nf 2 5 3\n";

// A picture file of one pixel, 24 bits.
std::string bitmap() {
  std::string file = "BM";
  const auto number = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) file += static_cast<char>(value >> 8 * i & 255);
  };
  for (const std::uint32_t value : {58U, 0U, 54U, 40U, 1U, 1U}) number(value, 4);
  number(1, 2);
  number(24, 2);
  for (const std::uint32_t value : {0U, 4U, 0U, 0U, 0U, 0U}) number(value, 4);
  number(0x4080FF, 4);
  return file;
}

class ReviewedAssetTest : public test::GpuTest {
 protected:
  // Rendering times take longer than everything else.
  ReviewedAssetTest() { options_.metrics.reset(index_of(analysis::Metric::kRenderingTime)); }

  ReviewedAsset review(
      const fs::path& asset, const pipeline::Progress& progress = [](double, const std::string&) {}) {
    AssetReviewer reviewer(options_, test::device_options());
    ReviewedAsset reviewed = reviewer.review(asset, progress);
    EXPECT_THAT(reviewer.take_validation_messages(), IsEmpty());
    return reviewed;
  }

  // That what is drawn and what is rated have the same rows.
  void expect_same_rows(const ReviewedAsset& reviewed) {
    const std::size_t rows = reviewed.analysis.instances.size();
    ASSERT_EQ(reviewed.scene.instances.size(), rows);
    ASSERT_EQ(reviewed.shades_of_instance.size(), rows);
    std::vector<const scene_render::GroupShades*> groups;
    for (const std::uint32_t index : reviewed.shades_of_instance) {
      const scene_render::GroupShades& shades = reviewed.shades.at(index);
      groups.push_back(shades.empty() ? nullptr : &shades);
    }
    scene_render::SceneModelBuilder builder(device());
    builder.add(reviewed.scene, groups);
    EXPECT_EQ(builder.finish().size(), rows);
  }

  TemporaryFolder folder_;
  pipeline::Options options_;
};

TEST_F(ReviewedAssetTest, HasAnalysisSceneAndGroups) {
  const fs::path asset = folder_.write("fold.obj", kFold);
  // The second comes from the analysis file.
  for (int run = 0; run < 2; ++run) {
    const ReviewedAsset reviewed = review(asset);
    ASSERT_EQ(reviewed.error, "");
    EXPECT_THAT(reviewed.messages, IsEmpty());
    EXPECT_EQ(reviewed.analysis.geometries.at(0).planar_groups, 2U);
    EXPECT_EQ(reviewed.analysis.asset, asset.string());
    expect_same_rows(reviewed);
    EXPECT_THAT(reviewed.shades, ElementsAre(scene_render::GroupShades{255, 255, 0}));
  }
}

TEST_F(ReviewedAssetTest, InstancesShareTheirGroups) {
  import::QuadGltf gltf;
  gltf.root["scenes"] = {{{"nodes", {0, 1, 2}}}};
  gltf.root["nodes"] = {
      {{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}, {{"mesh", 0}, {"scale", {1, 3, 1}}}};
  const ReviewedAsset reviewed = review(folder_.write("three.glb", gltf.binary()));
  ASSERT_EQ(reviewed.error, "");
  expect_same_rows(reviewed);
  EXPECT_THAT(reviewed.shades_of_instance, ElementsAre(0, 0, 1));
  EXPECT_THAT(reviewed.shades,
              ElementsAre(scene_render::GroupShades{255, 255}, scene_render::GroupShades{255, 255}));
}

TEST_F(ReviewedAssetTest, TexturesAreDecoded) {
  folder_.write("a.mtl", "newmtl red\nKd 1 1 1\nmap_Kd a.bmp\nnewmtl gone\nmap_Kd broken.bmp\n");
  folder_.write("a.bmp", bitmap());
  folder_.write("broken.bmp", "BM, but no picture");
  const ReviewedAsset reviewed = review(folder_.write(
      "a.obj",
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n"
      "usemtl gone\nf 3/3 2/2 1/1\n"));
  ASSERT_EQ(reviewed.error, "");
  expect_same_rows(reviewed);
  ASSERT_EQ(reviewed.scene.textures.size(), 2U);
  EXPECT_THAT(reviewed.scene.textures[0].pixels, ElementsAre(0x40, 0x80, 0xFF, 0xFF));
  EXPECT_THAT(reviewed.messages, Contains(HasSubstr("broken.bmp"))) << "known only since it was decoded";
}

TEST_F(ReviewedAssetTest, AnAssetWithoutMeshesHasItsRow) {
  const ReviewedAsset reviewed =
      review(folder_.write("empty.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                                         R"("nodes":[{"name":"nothing"}]})"));
  ASSERT_EQ(reviewed.error, "");
  EXPECT_EQ(reviewed.analysis.instances.size(), 1U);
  expect_same_rows(reviewed);
  EXPECT_THAT(reviewed.messages, Contains(HasSubstr("nothing to rate")));
}

TEST_F(ReviewedAssetTest, DegenerateMeshesHaveNoGroups) {
  const ReviewedAsset reviewed = review(folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"));
  ASSERT_EQ(reviewed.error, "");
  expect_same_rows(reviewed);
  EXPECT_THAT(reviewed.shades, ElementsAre(IsEmpty()));
}

TEST_F(ReviewedAssetTest, BadAssetsAreNoExceptions) {
  AssetReviewer reviewer(options_, test::device_options());
  const auto quiet = [](double, const std::string&) {};
  EXPECT_THAT(reviewer.review(folder_.path() / "missing.obj", quiet).error, HasSubstr("missing.obj"));
  EXPECT_THAT(reviewer.review(folder_.write("broken.glb", "glTF nonsense"), quiet).error,
              HasSubstr("broken.glb"));
  EXPECT_EQ(reviewer.review(folder_.write("good.obj", kFold), quiet).error, "") << "and the next one is good";
}

TEST_F(ReviewedAssetTest, WhatChangedMeanwhileIsNotDrawn) {
  const fs::path asset = folder_.write("fold.obj", kFold);
  const auto change = [&](double, const std::string& step) {
    if (step == "import for drawing") folder_.write("fold.obj", std::string(kFold) + "f 2 3 4\n");
  };
  EXPECT_THAT(review(asset, change).error, HasSubstr("it has changed since it was analysed"));
  const auto remove = [&](double, const std::string& step) {
    if (step == "import for drawing") fs::remove(asset);
  };
  EXPECT_THAT(review(asset, remove).error, HasSubstr("no such file"));
}

TEST_F(ReviewedAssetTest, ProgressNeverFallsAndReachesTheEnd) {
  double last = 0;
  std::vector<std::string> steps;
  review(folder_.write("fold.obj", kFold), [&](double fraction, const std::string& step) {
    EXPECT_GE(fraction, last) << step;
    last = fraction;
    steps.push_back(step);
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(steps.front(), "checking the analysis file");
  EXPECT_THAT(steps, Contains("import for drawing"));
  EXPECT_THAT(steps, Contains("planar groups for drawing"));
}

TEST_F(ReviewedAssetTest, WhatProgressThrowsComesOutAtEveryStep) {
  struct Left {};
  const fs::path asset = folder_.write("fold.obj", kFold);
  options_.use_analysis_files = false;
  int steps = 0;
  review(asset, [&](double, const std::string&) { ++steps; });
  ASSERT_GT(steps, 5);
  AssetReviewer reviewer(options_, test::device_options());
  for (int at = 1; at <= steps; ++at) {
    int step = 0;
    const auto leave = [&](double, const std::string&) {
      if (++step == at) throw Left();
    };
    EXPECT_THROW(reviewer.review(asset, leave), Left) << at;
  }
  EXPECT_EQ(reviewer.review(asset, [](double, const std::string&) {}).error, "");
}

TEST_F(ReviewedAssetTest, WithoutADeviceThereIsNoReview) {
  AssetReviewer reviewer(options_, {.selector = "there is no such device", .cache_folder = {}});
  const auto quiet = [](double, const std::string&) {};
  EXPECT_THROW(reviewer.review(folder_.write("fold.obj", kFold), quiet), gpu::NoDevice);
  EXPECT_THAT(reviewer.take_validation_messages(), IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer::viewer
