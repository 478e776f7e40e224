// Whose fault a lost device is, and what becomes of those whose fault it is not.
#include "service/device_worker.h"

#include "gpu/error.h"
#include "pipeline/pending_analysis.h"
#include "service/executor_fixture.h"

namespace scene_analyzer::service {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class DeviceWorkerTest : public ExecutorTest {
 protected:
  std::shared_ptr<Job> start(const mesh::AssetSource& asset) {
    const auto job = std::make_shared<Job>(order(asset));
    std::vector<Imported> imported(1);
    imported[0] = import(job);
    worker_.start(std::move(imported));
    return job;
  }
  // It is lost with the first step on the device.
  std::shared_ptr<Job> lose_with(const mesh::AssetSource& asset) {
    const auto job = std::make_shared<Job>(order(asset));
    std::vector<Imported> imported(1);
    bool on_device = false;
    imported[0] = import(job, [&](double, const std::string&) {
      if (on_device) throw gpu::DeviceLost("The device was lost.");
    });
    on_device = true;
    worker_.start(std::move(imported));
    return job;
  }
  Imported import(const std::shared_ptr<Job>& job, pipeline::Progress progress = {}) {
    return {.job = job,
            .analysis = pipeline_.prepare(job->order().asset, std::move(progress), job->options()),
            .picture = {},
            .bytes = 1,
            .wants_quiet = false};
  }

  std::vector<std::shared_ptr<Job>> again_;
  std::uint64_t released_ = 0;
  pipeline::Pipeline pipeline_{{}, device};
  DeviceWorker worker_{pipeline_,
                       metrics_,
                       {.try_again = [this](std::shared_ptr<Job> job) { again_.push_back(std::move(job)); },
                        .released = [this](std::uint64_t bytes) { released_ += bytes; },
                        .error = [](const std::string&) {}}};
  // Each of its triangles might be the start: to find the best takes many seconds.
  const std::filesystem::path torus_ = write(test_meshes::torus(300, 200), "torus.obj");
};

TEST_F(DeviceWorkerTest, BesideASearchNobodyKnowsWhoseFaultItIs) {
  options_.parameters.start_searches = UINT64_MAX;
  for (int i = 0; i < 3; ++i) {
    again_.clear();
    const auto searching = start(torus_);
    ASSERT_EQ(worker_.pending(), 1U);
    const auto last = lose_with(cube_);
    EXPECT_THAT(again_, ElementsAre(last, searching));
    EXPECT_EQ(worker_.pending(), 0U);
    EXPECT_FALSE(last->is_done() || searching->is_done());
    EXPECT_EQ(released_, 2U * (i + 1));
  }
  EXPECT_NO_THROW(worker_.losses().check(cube_)) << "it was never alone";
}

TEST_F(DeviceWorkerTest, WithNothingBesideItAnAssetIsTriedTwice) {
  for (int i = 0; i < 2; ++i)
    EXPECT_THAT(ending(*lose_with(cube_)), StartsWith("unavailable: The device was lost."));
  EXPECT_THAT(ending(*start(cube_)), HasSubstr("cube.obj: the device was lost 2 times"))
      << "it was imported before that was known";
  EXPECT_EQ(released_, 3U);
  EXPECT_THAT(again_, IsEmpty());
  const auto other = start(write(test_meshes::heightfield(3, 1, 1), "other.obj"));
  worker_.finish_all();
  EXPECT_EQ(ending(*other), "");
}

}  // namespace
}  // namespace scene_analyzer::service
