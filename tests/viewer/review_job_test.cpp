// The job of the window: all assets in order, one failure among them, stopped anywhere.
#include "viewer/review_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <thread>

#include "support/gpu_test.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;
using Finished = ReviewJob::Finished;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::seconds kPatience(120);
constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\no triangle\nf 1 2 3\n";

// What a window does with a job: it sleeps until there is news.
class Sleeper {
 public:
  std::function<void()> alarm() {
    return [this] {
      const std::scoped_lock lock(mutex_);
      ++news_;
      changed_.notify_all();
    };
  }
  // Whether `holds` became true.
  bool wait_until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    std::unique_lock lock(mutex_);
    while (true) {
      const long seen = news_;
      lock.unlock();
      if (holds()) return true;
      lock.lock();
      if (!changed_.wait_until(lock, end, [&] { return news_ != seen; })) return false;
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  long news_ = 0;
};

class ReviewJobTest : public test::GpuTest {
 protected:
  // Rendering times take longer than everything else.
  ReviewJobTest() { options_.metrics.reset(index_of(analysis::Metric::kRenderingTime)); }

  fs::path triangle(const std::string& name) { return folder_.write(name, kTriangle); }

  std::unique_ptr<ReviewJob> start(std::vector<fs::path> assets) {
    return std::make_unique<ReviewJob>(std::move(assets), options_, test::device_options(), sleeper_.alarm());
  }

  // Everything that the job gives, in the order of arrival.
  std::vector<Finished> all_of(ReviewJob& job) {
    std::vector<Finished> all;
    EXPECT_TRUE(sleeper_.wait_until([&] {
      const bool done = job.done();
      for (Finished& finished : job.take_finished()) all.push_back(std::move(finished));
      return done;
    }));
    EXPECT_THAT(job.take_validation_messages(), IsEmpty());
    return all;
  }

  TemporaryFolder folder_;
  pipeline::Options options_;
  Sleeper sleeper_;
};

TEST_F(ReviewJobTest, AllAssetsComeOnceInTheirOrder) {
  const fs::path first = triangle("first.obj"), last = triangle("last.obj");
  const auto job = start({first, folder_.path() / "missing.obj", folder_.write("broken.glb", "glTF"), last});
  const std::vector<Finished> all = all_of(*job);
  ASSERT_EQ(all.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(all[i].asset, i);
  EXPECT_EQ(all[0].error, "");
  EXPECT_EQ(all[0].analysis.asset, first.string());
  EXPECT_EQ(all[0].scene.instances.size(), 1U);
  EXPECT_THAT(all[0].shades, ElementsAre(scene_render::GroupShades{0}));
  EXPECT_THAT(all[1].error, HasSubstr("missing.obj"));
  EXPECT_THAT(all[2].error, HasSubstr("broken.glb"));
  EXPECT_EQ(all[3].error, "");
  EXPECT_THAT(job->take_finished(), IsEmpty());
  EXPECT_EQ(job->failure(), std::nullopt);
}

TEST_F(ReviewJobTest, ProgressGoesFromTheFirstToTheEnd) {
  std::vector<ReviewJob::Progress> seen;
  const auto job = start({triangle("a.obj"), triangle("b.obj")});
  EXPECT_TRUE(sleeper_.wait_until([&] {
    const bool done = job->done();
    seen.push_back(job->progress());
    return done;
  }));
  double before = 0;
  for (const ReviewJob::Progress& progress : seen) {
    EXPECT_EQ(progress.assets, 2U);
    const double now = static_cast<double>(progress.asset) + (progress.asset < 2 ? progress.fraction : 0);
    EXPECT_GE(now, before);
    before = now;
    const std::string expected = progress.asset == 0 ? "a.obj" : progress.asset == 1 ? "b.obj" : "";
    EXPECT_TRUE(progress.name == expected || progress.name.empty()) << progress.name;
  }
  EXPECT_EQ(seen.back().asset, 2U);
  EXPECT_EQ(seen.back().fraction, 1);
}

TEST_F(ReviewJobTest, WithoutAssetsItIsDone) {
  const auto job = start({});
  EXPECT_THAT(all_of(*job), IsEmpty());
  EXPECT_EQ(job->failure(), std::nullopt);
  EXPECT_EQ(job->progress().assets, 0U);
}

TEST_F(ReviewJobTest, AnAssetGivenTwiceIsAnalysedOnce) {
  options_.use_analysis_files = false;
  const fs::path asset = triangle("a.obj"), other = folder_.path() / "." / "a.obj";
  std::vector<Finished> all;
  std::set<std::string> steps_of_second;
  ReviewJob job({asset, triangle("b.obj"), other, asset}, options_, test::device_options(), sleeper_.alarm());
  EXPECT_TRUE(sleeper_.wait_until([&] {
    const bool done = job.done();
    const ReviewJob::Progress progress = job.progress();
    if (progress.asset == 2) steps_of_second.insert(progress.step);
    for (Finished& finished : job.take_finished()) all.push_back(std::move(finished));
    return done;
  }));
  ASSERT_EQ(all.size(), 4U);
  EXPECT_THAT(steps_of_second, testing::IsSubsetOf({std::string()}));
  for (const std::size_t i : {0U, 2U, 3U}) {
    EXPECT_EQ(all[i].error, "");
    EXPECT_EQ(all[i].asset, i);
    EXPECT_EQ(all[i].analysis.geometries.at(0).triangles, 1U);
    EXPECT_EQ(all[i].scene.meshes.at(0).positions.size(), 9U);
  }
  EXPECT_EQ(all[2].analysis.asset, other.string());
  EXPECT_EQ(all[3].analysis.asset, asset.string());
}

TEST_F(ReviewJobTest, StoppedInTheMiddleItEndsSoon) {
  std::vector<fs::path> assets;
  for (int i = 0; i < 50; ++i) assets.push_back(triangle("a" + std::to_string(i) + ".obj"));
  const auto job = start(assets);
  EXPECT_TRUE(sleeper_.wait_until([&] { return job->progress().asset >= 1; }));
  job->request_stop();
  const std::vector<Finished> all = all_of(*job);
  EXPECT_GE(all.size(), 1U);
  EXPECT_LT(all.size(), 50U);
  for (const Finished& finished : all) EXPECT_EQ(finished.error, "") << "what was begun is not half there";
  EXPECT_EQ(job->failure(), std::nullopt) << "that was wanted";
}

TEST_F(ReviewJobTest, ClosingItAtAnyTimeIsQuick) {
  std::vector<fs::path> assets;
  for (int i = 0; i < 20; ++i) assets.push_back(triangle("a" + std::to_string(i) + ".obj"));
  options_.use_analysis_files = false;
  for (int milliseconds = 0; milliseconds < 400; milliseconds += 37) {
    auto job = start(assets);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    const auto begin = std::chrono::steady_clock::now();
    job.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << milliseconds;
  }
}

TEST_F(ReviewJobTest, ClosingItDoesNotWaitForAnImport) {
  setenv("SCENE_ANALYZER_TEST_WORKER", "hang", 1);
  auto job = start({triangle("a.obj")});
  EXPECT_TRUE(sleeper_.wait_until([&] { return job->progress().step == "importing"; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto begin = std::chrono::steady_clock::now();
  job->request_stop();
  EXPECT_THAT(all_of(*job), IsEmpty());
  EXPECT_EQ(job->failure(), std::nullopt);
  job.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
  unsetenv("SCENE_ANALYZER_TEST_WORKER");
}

TEST_F(ReviewJobTest, WithoutADeviceItSaysWhy) {
  ReviewJob job({triangle("a.obj")}, options_, {.selector = "there is no such device", .cache_folder = {}},
                sleeper_.alarm());
  EXPECT_THAT(all_of(job), IsEmpty());
  EXPECT_THAT(job.failure().value_or(""), HasSubstr("there is no such device"));
}

TEST_F(ReviewJobTest, NobodyHasToListen) {
  ReviewJob job({triangle("a.obj")}, options_, test::device_options());
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!job.done() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(job.take_finished().size(), 1U);
}

// The window draws on its own device meanwhile.
TEST_F(ReviewJobTest, TwoDevicesDoNotDisturbEachOther) {
  const auto job = start({triangle("a.obj"), triangle("b.obj"), triangle("c.obj")});
  while (!job->done()) {
    const std::vector<std::uint32_t> numbers = {1, 2, 3, 4};
    gpu::Buffer buffer = device().make_buffer("meanwhile", 16);
    device().upload(buffer, 0, std::as_bytes(std::span(numbers)));
    std::vector<std::uint32_t> back(4);
    device().download(buffer, 0, std::as_writable_bytes(std::span(back)));
    ASSERT_EQ(back, numbers);
  }
  EXPECT_EQ(all_of(*job).size(), 3U);
}

}  // namespace
}  // namespace scene_analyzer::viewer
