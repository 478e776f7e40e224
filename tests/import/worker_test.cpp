// However the worker ends, the caller gets one sentence and goes on.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <random>
#include <stop_token>
#include <thread>

#include "import/temp_folder.h"
#include "import/wire_builder.h"
#include "mutate.h"

namespace scene_analyzer::import {
namespace {

using testing::HasSubstr;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// See tests/support/worker_main.cpp.
class Misbehaviour {
 public:
  explicit Misbehaviour(const char* how) { setenv("SCENE_ANALYZER_TEST_WORKER", how, 1); }
  ~Misbehaviour() { unsetenv("SCENE_ANALYZER_TEST_WORKER"); }
  Misbehaviour(const Misbehaviour&) = delete;
  Misbehaviour& operator=(const Misbehaviour&) = delete;
};

std::string refusal_when(const char* how, const Limits& limits = {}) {
  const TempFolder folder;
  const Misbehaviour misbehaviour(how);
  return refusal(folder.write("a.obj", kTriangle), limits);
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator folder("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(folder), end(folder)));
}

TEST(Worker, ACrashNamesTheSignal) {
  EXPECT_THAT(refusal_when("crash"), HasSubstr("a.obj: the importer crashed (SIGSEGV)"));
}

TEST(Worker, AHangEndsAtTheTimeLimit) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal_when("hang", {.seconds = 0.3}), HasSubstr("takes longer than the limit of 0.3 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Worker, AskedToStopItIsKilled) {
  const TempFolder folder;
  const std::filesystem::path asset = folder.write("a.obj", kTriangle);
  for (const int milliseconds : {0, 200}) {
    const Misbehaviour misbehaviour("hang");
    std::stop_source stop;
    const std::jthread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      stop.request_stop();
    });
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THROW(import_asset(asset, {.stop = stop.get_token()}), Stopped);
    EXPECT_THROW(import_asset(asset, {.stop = stop.get_token()}, Textures::kDecode), Stopped);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  }
  EXPECT_EQ(refusal(asset, {.stop = std::stop_source().get_token()}), "");
}

TEST(Worker, AnUnexpectedExitIsTold) {
  EXPECT_THAT(refusal_when("exit"), HasSubstr("exit code 42"));
}

TEST(Worker, SilenceAndNonsenseAreNoAnswer) {
  EXPECT_THAT(refusal_when("silence"), HasSubstr("no usable answer"));
  EXPECT_THAT(refusal_when("garbage"), HasSubstr("no usable answer"));
}

#ifndef __SANITIZE_ADDRESS__
TEST(Worker, TheMemoryLimitIsToldApartFromACrash) {
  const TempFolder folder;
  std::string points =
      "ply\nformat ascii 1.0\nelement vertex 4000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 4000000; ++i) points += "1 2 3\n";
  points += "3 0 1 2\n";
  const std::filesystem::path asset = folder.write("big.ply", points);
  EXPECT_THAT(refusal(asset, {.memory_bytes = std::uint64_t{60} << 20}),
              HasSubstr("more than the limit of 60 MiB"));
  EXPECT_EQ(refusal(asset), "");
}
#endif

// What Landlock and seccomp bring is said by missing_isolation() where the kernel lacks it.
TEST(Worker, ConfinedItReadsItsFolderAndDoesNothingElse) {
  const std::vector<std::string> missing = missing_isolation();
  if (!missing.empty()) GTEST_SKIP() << missing.front();
  EXPECT_THAT(refusal_when("probe"), testing::EndsWith("a.obj: probe:"));
}

TEST(Worker, AnyAnswerIsSurvived) {
  const TempFolder folder;
  const Misbehaviour misbehaviour("bytes");
  const std::vector<std::byte> scene = small_scene();
  const std::string whole(reinterpret_cast<const char*>(scene.data()), scene.size());
  EXPECT_EQ(refusal(folder.write("a.obj", whole)), "") << "the double answers what it is given";
  std::mt19937_64 random(11);
  std::size_t scenes = 0, refused = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string message = refusal(folder.write("a.obj", fuzz::mutate(whole, random) + " "));
    ++(message.empty() ? scenes : refused);
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_GT(scenes, 10u);
  EXPECT_GT(refused, 10u);
}

TEST(Worker, NothingIsLeftBehind) {
  const TempFolder folder;
  const std::filesystem::path good = folder.write("good.obj", kTriangle);
  EXPECT_EQ(refusal(good), "");  // whatever the first import opens once
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(refusal(good), "");
    EXPECT_NE(refusal_when("crash"), "");
    EXPECT_NE(refusal_when("hang", {.seconds = 0.05}), "");
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child was not reaped";
}

TEST(Worker, SeveralAtOnce) {
  const TempFolder folder;
  const std::filesystem::path good = folder.write("good.obj", kTriangle);
  const std::filesystem::path bad = folder.write("bad.glb", "glTF");
  std::vector<std::thread> threads;
  std::array<int, 8> right{};
  for (std::size_t i = 0; i < right.size(); ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 4; ++round) right[i] += refusal(good).empty() && !refusal(bad).empty();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(right, testing::Each(4));
}

TEST(Worker, TheSceneOutlivesItsMoves) {
  const TempFolder folder;
  mesh::Scene first = import_asset(folder.write("a.obj", kTriangle));
  mesh::Scene second = std::move(first);
  mesh::Scene third;
  third = std::move(second);
  EXPECT_EQ(third.meshes.at(0).positions[3], 1.0f);
}

}  // namespace
}  // namespace scene_analyzer::import
