// executor_fixture.h — An executor on the test's device, assets for it, and what each gives alone.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "analysis_file/sample.h"
#include "pipeline/pipeline.h"
#include "service/executor.h"
#include "support/gpu_test.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {

// Far more than anything takes: a test ends with it only when what it waits for never comes.
inline constexpr std::chrono::minutes kForEver(2);

// What a thread waits at until the test opens it.
class Gate {
 public:
  void open() { opened_.set_value(); }
  void wait() { EXPECT_EQ(open_.wait_for(kForEver), std::future_status::ready) << "nobody opens the gate"; }

 private:
  std::promise<void> opened_;
  const std::shared_future<void> open_ = opened_.get_future().share();
};

// True as soon as `holds` does.
inline bool comes_true(const std::function<bool()>& holds) {
  for (const auto deadline = std::chrono::steady_clock::now() + kForEver;
       std::chrono::steady_clock::now() < deadline; std::this_thread::yield())
    if (holds()) return true;
  return false;
}

// Waits until it is done; "" or the refusal, "invalid: no such file".
inline std::string ending(Job& job, Answer& answer) {
  Job::State state = job.wait(UINT64_MAX, std::chrono::steady_clock::now());
  while (!state.done) {
    const std::uint64_t seen = state.version;
    state = job.wait(seen, std::chrono::steady_clock::now() + kForEver);
    if (state.version == seen) return "never done";
  }
  answer = job.take_answer();
  if (!answer.refusal) return answer.analysis ? "" : "neither an analysis nor a refusal";
  return std::string(to_string(answer.refusal->reason())) + ": " + answer.refusal->what();
}
inline std::string ending(Job& job) {
  Answer answer;
  return ending(job, answer);
}

inline PictureOrder picture_order(std::uint32_t width, std::uint32_t height) {
  PictureOrder picture;
  picture.format.width = width;
  picture.format.height = height;
  return picture;
}

// See tests/support/worker_main.cpp. Begins and ends while nothing is being imported.
class Misbehaviour {
 public:
  explicit Misbehaviour(const char* how) { ::setenv("SCENE_ANALYZER_TEST_WORKER", how, 1); }
  ~Misbehaviour() { ::unsetenv("SCENE_ANALYZER_TEST_WORKER"); }
  Misbehaviour(const Misbehaviour&) = delete;
  Misbehaviour& operator=(const Misbehaviour&) = delete;
};

class ExecutorTest : public test::GpuTest {
 protected:
  ExecutorTest() {
    options_.use_analysis_files = false;
    // Rendering times take longer than everything else, and differ from run to run.
    options_.metrics.reset(index_of(analysis::Metric::kRenderingTime));
  }

  std::unique_ptr<Executor> executor(const ExecutorOptions& options = {.import_workers = 2},
                                     std::function<gpu::Device&()> its_device = device) {
    return std::make_unique<Executor>(options, std::move(its_device), metrics_,
                                      [this](const std::string& message) {
                                        const std::lock_guard lock(mutex_);
                                        errors_.push_back(message);
                                      });
  }
  std::vector<std::string> errors() {
    const std::lock_guard lock(mutex_);
    return errors_;
  }
  Order order(const mesh::AssetSource& asset) const {
    return {.asset = asset, .files = nullptr, .options = options_, .picture = std::nullopt};
  }

  std::filesystem::path write(const test_meshes::TestMesh& mesh, const std::string& name) const {
    std::string text = "o " + mesh.name + '\n';
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      text += "v " + std::to_string(mesh.positions[i]) + ' ' + std::to_string(mesh.positions[i + 1]) + ' ' +
              std::to_string(mesh.positions[i + 2]) + '\n';
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      text += "f " + std::to_string(mesh.indices[i] + 1) + ' ' + std::to_string(mesh.indices[i + 1] + 1) +
              ' ' + std::to_string(mesh.indices[i + 2] + 1) + '\n';
    return folder_.write(name, text);
  }
  static pipeline::Outcome alone(const mesh::AssetSource& asset, const pipeline::Options& options) {
    return pipeline::Pipeline(options, device).analyze(asset);
  }
  static void expect_as_alone(Job& job, const pipeline::Outcome& outcome) {
    SCOPED_TRACE(job.order().asset.name);
    Answer answer;
    ASSERT_EQ(ending(job, answer), "");
    ASSERT_TRUE(outcome.analysis) << outcome.error;
    analysis_file::expect_same(*answer.analysis, *outcome.analysis);
    EXPECT_EQ(answer.messages, outcome.messages);
    EXPECT_FALSE(answer.from_store);
    EXPECT_EQ(answer.png, "");
  }

  TemporaryFolder folder_;
  const std::filesystem::path cube_ = write(test_meshes::cube(), "cube.obj");
  pipeline::Options options_;
  Metrics metrics_{[] { return Levels{}; }};

 private:
  std::mutex mutex_;
  std::vector<std::string> errors_;
};

}  // namespace scene_analyzer::service
