// Assets that come one after the other into a scene that is already looked at.
#include "viewer/reviewed_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/gpu_test.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::viewer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using ReviewedSceneTest = test::GpuTest;

TEST_F(ReviewedSceneTest, RowsStayAndFailuresAreSaid) {
  const TemporaryFolder folder;
  pipeline::Options options;
  options.metrics.reset(index_of(analysis::Metric::kRenderingTime));
  AssetReviewer reviewer(options, test::device_options());
  const auto review = [&](const std::string& name) {
    const auto file = folder.write(name + ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no " + name + "\nf 1 2 3\n");
    return reviewer.review(file, [](double, const std::string&) {});
  };
  ReviewedScene scene(device());
  EXPECT_FALSE(scene.is_ready());
  ReviewedAsset first = review("first");
  for (analysis::GeometryAnalysis& geometry : first.analysis.geometries) geometry.fourier_transform.reset();
  EXPECT_TRUE(scene.add({first}).all_good);
  EXPECT_TRUE(scene.is_ready());
  EXPECT_EQ(scene.model().size(), 1U);

  // The first has no Fourier rating, and what is shown is rated without.
  EXPECT_FALSE(scene.computed()[index_of(analysis::Metric::kFourierTransform)]);
  ratings::Options shown;
  shown.metrics = scene.computed();
  scene.rate(shown);

  ReviewedAsset failed;
  failed.error = "third.obj: no such file";
  failed.messages = {"third.obj: a warning"};
  const ReviewedScene::Arrived arrived = scene.add({review("second"), failed});
  EXPECT_FALSE(arrived.all_good);
  EXPECT_THAT(arrived.messages, ElementsAre("third.obj: a warning", "third.obj: no such file"));
  ASSERT_EQ(scene.rating().meshes.size(), 2U);
  EXPECT_EQ(scene.model().size(), 2U);
  EXPECT_EQ(scene.name(0), "first");
  EXPECT_EQ(scene.name(1), "second");
  EXPECT_TRUE(scene.computed()[index_of(analysis::Metric::kFourierTransform)]);
  EXPECT_FALSE(scene.computed()[index_of(analysis::Metric::kRenderingTime)]);
  EXPECT_THAT(reviewer.take_validation_messages(), IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer::viewer
