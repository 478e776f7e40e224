// Jobs beside each other: each has the answer that it would have had alone.
#include "service/executor.h"

#include <set>

#include "gpu/error.h"
#include "pictures/picture_content.h"
#include "service/executor_fixture.h"
#include "support/png.h"

namespace scene_analyzer::service {
namespace {

using analysis::Metric;
using testing::AllOf;
using testing::Gt;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(ExecutorTest, AJobHasWhatThePipelineGives) {
  const mesh::AssetSource asset = write(test_meshes::heightfield(12, 0.5, 3), "hills.obj");
  const pipeline::Outcome expected = alone(asset, options_);
  const auto executor = this->executor();
  EXPECT_EQ(executor->device(), expected.analysis.value().device);
  expect_as_alone(*executor->submit(order(asset)), expected);
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(ExecutorTest, AnAssetIsCalledAsTheOrderCallsIt) {
  const mesh::AssetSource called(cube_, "what the client calls it");
  Answer answer;
  ASSERT_EQ(ending(*executor()->submit(order(called)), answer), "");
  EXPECT_EQ(answer.analysis->asset, "what the client calls it");
}

TEST_F(ExecutorTest, ManyAtOnceHaveWhatEachHasAlone) {
  std::vector<mesh::AssetSource> assets;
  for (std::uint32_t i = 1; i <= 4; ++i)
    assets.emplace_back(write(test_meshes::heightfield(2 * i, 0.1 * i, i), std::to_string(i) + ".obj"));
  assets.emplace_back(write(test_meshes::isolated_soup(20, 1), "soup.obj"));
  assets.emplace_back(folder_.write("nothing.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n"));
  std::vector<pipeline::Options> variants(4, options_);
  variants[1].parameters.alpha_degrees = 30;
  variants[2].parameters.dim = 5;
  variants[3].metrics.reset().set(index_of(Metric::kCooccurrenceContrast));
  std::vector<pipeline::Outcome> expected;
  for (const mesh::AssetSource& asset : assets)
    for (const pipeline::Options& options : variants) expected.push_back(alone(asset, options));

  // The device comes when all are imported: what can go together does.
  Executor* asked = nullptr;
  Gate begun;
  const auto executor = this->executor({.import_workers = 3}, [&]() -> gpu::Device& {
    begun.wait();
    EXPECT_TRUE(comes_true([&] { return asked->depth().waiting == 0; }));
    return device();
  });
  asked = executor.get();
  std::vector<std::shared_ptr<Job>> jobs;
  for (const mesh::AssetSource& asset : assets)
    for (const pipeline::Options& options : variants) {
      Order one = order(asset);
      one.options = options;
      jobs.push_back(executor->submit(std::move(one)));
    }
  begun.open();
  for (std::size_t i = 0; i < jobs.size(); ++i) expect_as_alone(*jobs[i], expected[i]);
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(ExecutorTest, WithRoomForOneSceneTheyGoOneByOne) {
  const mesh::AssetSource asset = cube_;
  const pipeline::Outcome expected = alone(asset, options_);
  const auto executor = this->executor({.import_workers = 2, .most_bytes = 1});
  std::vector<std::shared_ptr<Job>> jobs;
  for (int i = 0; i < 8; ++i) jobs.push_back(executor->submit(order(asset)));
  for (const auto& job : jobs) expect_as_alone(*job, expected);
}

TEST_F(ExecutorTest, RenderingTimesComeBesideOtherJobs) {
  const mesh::AssetSource asset = cube_;
  const pipeline::Outcome expected = alone(asset, options_);
  Order timed = order(asset);
  timed.options.metrics.set(index_of(Metric::kRenderingTime));
  timed.options.timing_budget = 0.05;
  timed.options.timing_width = timed.options.timing_height = 64;
  timed.options.parameters.steps = 1;
  const auto executor = this->executor();
  std::vector<std::shared_ptr<Job>> jobs, timed_jobs;
  for (int i = 0; i < 4; ++i) {
    jobs.push_back(executor->submit(order(asset)));
    timed_jobs.push_back(executor->submit(timed));
    jobs.push_back(executor->submit(order(asset)));
  }
  for (const auto& job : jobs) expect_as_alone(*job, expected);
  for (const auto& job : timed_jobs) {
    Answer answer;
    ASSERT_EQ(ending(*job, answer), "");
    ASSERT_THAT(answer.analysis->timings, SizeIs(1));
    EXPECT_GT(answer.analysis->timings[0].times.at(0).mean_ns, 0);
    EXPECT_EQ(answer.analysis->timings[0].conditions.width, 64U);
  }
}

TEST_F(ExecutorTest, WhatTheStoreKnowsNeedsNeitherImportNorDevice) {
  options_.use_analysis_files = true;
  options_.cache_folder = folder_.path() / "cache";
  const mesh::AssetSource asset = cube_;
  Answer first, second;
  ASSERT_EQ(ending(*executor()->submit(order(asset)), first), "");
  EXPECT_FALSE(first.from_store);
  const Misbehaviour misbehaviour("exit");
  const auto executor = this->executor({}, []() -> gpu::Device& { throw gpu::NoDevice("it was asked for"); });
  ASSERT_EQ(ending(*executor->submit(order(asset)), second), "");
  EXPECT_TRUE(second.from_store);
  analysis_file::expect_same(*second.analysis, *first.analysis);
  options_.parameters.alpha_degrees = 1;
  EXPECT_THAT(ending(*executor->submit(order(asset))), HasSubstr("exit code 42")) << "the trap does not hold";
}

TEST_F(ExecutorTest, BrokenAssetsAreNamedAndNoTroubleToOthers) {
  const mesh::AssetSource good = cube_;
  const pipeline::Outcome expected = alone(good, options_);
  const auto executor = this->executor();
  const auto bad = executor->submit(order(mesh::AssetSource(folder_.write("0.obj", "no model"), "bad.obj")));
  const auto missing = executor->submit(order(folder_.path() / "missing.obj"));
  const auto other = executor->submit(order(good));
  Order many = order(good);
  many.options.import_limits.triangles = 11;
  const auto large = executor->submit(std::move(many));
  EXPECT_THAT(ending(*bad), StartsWith("invalid: bad.obj: "));
  EXPECT_THAT(ending(*missing), AllOf(StartsWith("invalid: "), HasSubstr("missing.obj: no such file")));
  EXPECT_THAT(ending(*large), AllOf(StartsWith("invalid: "), HasSubstr("12 triangles")));
  expect_as_alone(*other, expected);
  EXPECT_THAT(errors(), IsEmpty()) << "that is not the machine's fault";
}

TEST_F(ExecutorTest, WhatTakesTooLongAlsoAloneIsTooLarge) {
  const auto executor = this->executor();
  {
    const Misbehaviour misbehaviour("hang");
    Order slow = order(cube_);
    slow.options.import_limits.seconds = 0.2;
    EXPECT_THAT(ending(*executor->submit(std::move(slow))),
                AllOf(StartsWith("too_large: "), HasSubstr("cube.obj"), HasSubstr("0.2 s")));
  }
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "");
}

TEST_F(ExecutorTest, ProgressNeverFalls) {
  options_.metrics.set(index_of(Metric::kRenderingTime));
  options_.timing_budget = 0.05;
  options_.parameters.steps = 1;
  Order ordered = order(write(test_meshes::heightfield(20, 0.5, 3), "hills.obj"));
  ordered.picture = picture_order(64, 64);
  const auto executor = this->executor();
  const auto job = executor->submit(std::move(ordered));
  std::vector<Job::State> states = {job->wait(UINT64_MAX, std::chrono::steady_clock::now())};
  while (!states.back().done) {
    const Job::State state = job->wait(states.back().version, std::chrono::steady_clock::now() + kForEver);
    ASSERT_GT(state.version, states.back().version) << "it never ends";
    EXPECT_GE(state.fraction, states.back().fraction);
    EXPECT_NE(state.step, "");
    states.push_back(state);
  }
  EXPECT_EQ(ending(*job), "");
  EXPECT_GE(states.front().fraction, 0);
  EXPECT_EQ(states.back().fraction, 1);
  EXPECT_GT(states.size(), 3U);
}

class ExecutorPictureTest : public ExecutorTest {
 protected:
  Order picture_of(const mesh::AssetSource& asset, const PictureOrder& picture) const {
    Order ordered = order(asset);
    ordered.picture = picture;
    return ordered;
  }
};

TEST_F(ExecutorPictureTest, ComesWithTheAnalysis) {
  const mesh::AssetSource asset = cube_;
  const pipeline::Outcome expected = alone(asset, options_);
  const auto executor = this->executor();
  using pictures::Subject;
  for (const Subject subject :
       {Subject::kMetric, Subject::kAggregate, Subject::kPlanarGroups, Subject::kOwnColors}) {
    PictureOrder picture = picture_order(320, 200);
    picture.content.subject = subject;
    Answer answer;
    ASSERT_EQ(ending(*executor->submit(picture_of(asset, picture)), answer), "");
    analysis_file::expect_same(*answer.analysis, expected.analysis.value());
    EXPECT_THAT(answer.png, StartsWith("\x89PNG\r\n\x1a\n"));
    const test::Png png = test::decode_png(answer.png);
    EXPECT_EQ(png.width, 320);
    EXPECT_EQ(png.height, 200);
    EXPECT_THAT(std::set(png.pixels.begin(), png.pixels.end()), SizeIs(Gt(10))) << "there is nothing on it";
  }
}

TEST_F(ExecutorPictureTest, IsDrawnOfWhatTheStoreKnows) {
  options_.use_analysis_files = true;
  options_.cache_folder = folder_.path() / "cache";
  const mesh::AssetSource asset = cube_;
  const auto executor = this->executor();
  Answer first, second;
  const PictureOrder picture = picture_order(320, 200);
  ASSERT_EQ(ending(*executor->submit(picture_of(asset, picture)), first), "");
  ASSERT_EQ(ending(*executor->submit(picture_of(asset, picture)), second), "");
  EXPECT_FALSE(first.from_store);
  EXPECT_TRUE(second.from_store);
  EXPECT_TRUE(first.png == second.png);
}

// The analysis is there, so that only the textures are imported.
TEST_F(ExecutorPictureTest, WhatTakesTooLongAlsoAloneIsTooLarge) {
  options_.use_analysis_files = true;
  options_.cache_folder = folder_.path() / "cache";
  const PictureOrder picture = picture_order(64, 64);
  const auto executor = this->executor();
  ASSERT_EQ(ending(*executor->submit(order(cube_))), "");
  {
    const Misbehaviour misbehaviour("hang");
    Order slow = picture_of(cube_, picture);
    slow.options.import_limits.seconds = 0.2;
    EXPECT_THAT(ending(*executor->submit(std::move(slow))),
                AllOf(StartsWith("too_large: "), HasSubstr("0.2 s")));
  }
  EXPECT_EQ(ending(*executor->submit(picture_of(cube_, picture))), "");
}

TEST_F(ExecutorPictureTest, OfNothingIsRefused) {
  const mesh::AssetSource nothing =
      folder_.write("nothing.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n");
  const PictureOrder picture = picture_order(64, 64);
  const auto executor = this->executor();
  EXPECT_THAT(ending(*executor->submit(picture_of(nothing, picture))), StartsWith("invalid: "));
  EXPECT_EQ(ending(*executor->submit(picture_of(cube_, picture))), "");
}

TEST_F(ExecutorPictureTest, BeyondTheDeviceIsRefused) {
  const PictureOrder picture = picture_order(1'000'000, 64);
  const auto executor = this->executor();
  EXPECT_THAT(ending(*executor->submit(picture_of(cube_, picture))),
              testing::AnyOf(StartsWith("invalid: "), StartsWith("too_large: ")));
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "");
  EXPECT_THAT(errors(), IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer::service
