// SIGINT, SIGTERM and SIGKILL while the built program runs.
#include <chrono>
#include <csignal>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/assets.h"
#include "faults/fault_test.h"
#include "files/temporary_name.h"

namespace scene_analyzer::faults {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Promised is a second, which is printed: how long a machine that is busy with other work takes is not the
// program's doing. What never ends by itself, or takes minutes, still fails.
constexpr double kLongestStop = 30;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void sleep_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// 125000 triangles: a few seconds from the import to the picture.
std::string large_obj() {
  return obj_of(cli::flat_grid(250), "grid");
}

class InterruptsTest : public FaultTest {
 protected:
  // Sends `signal` and waits for the end, which has to come in time.
  ProgramResult stop(RunningProgram& program, int signal) {
    const auto begin = Clock::now();
    program.send(signal);
    ProgramResult result = program.wait();
    const double seconds = seconds_since(begin);
    EXPECT_LT(seconds, kLongestStop);
    longest_ = std::max(longest_, seconds);
    return result;
  }
  void expect_stopped(const ProgramResult& result, int signal) {
    EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
    EXPECT_THAT(complaints(result), ElementsAre(StartsWith("warning: stopped after "))) << result.err;
    EXPECT_EQ(result.out, "");
  }
  void wait_for(RunningProgram& program, const std::function<bool()>& condition) {
    const auto begin = Clock::now();
    while (!condition()) {
      ASSERT_LT(seconds_since(begin), 60) << program.err();
      ASSERT_FALSE(program.has_ended()) << program.err();
      sleep_for(0.005);
    }
  }
  void report_stops(int count) const {
    std::cout << "signals: " << count << ", the longest took " << longest_ << " s to stop the program\n";
  }

  double longest_ = 0;
};

TEST_F(InterruptsTest, AtAnyMomentOfALargeAsset) {
  assets_ = {{"large.obj", large_obj()}};
  const auto begin = Clock::now();
  run_undisturbed({"--json", "out.json", "--image", "out.png", "--size", "1600x1200", "--export", "out.glb"},
                  {"out.json", "out.png", "out.glb"});
  const double whole = seconds_since(begin);
  std::mt19937 random(1);
  const int stops = static_cast<int>(fault_runs(3));
  for (int i = 0; i < stops; ++i) {
    const double moment = std::uniform_real_distribution<double>(0.05, 1)(random) * whole;
    SCOPED_TRACE(moment);
    const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
    const auto program = start();
    sleep_for(moment);
    const bool ended = program->has_ended();
    const ProgramResult result = stop(*program, signal);
    if (ended || result.exit_code == 0)  // it came too late
      EXPECT_EQ(result.exit_code, 0);
    else
      EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
    expect_files_absent_or_whole();
  }
  report_stops(stops);
}

TEST_F(InterruptsTest, WhileRenderingTimesAreMeasured) {
  run_undisturbed({"--timing-budget", "0.1", "--steps", "2"}, {});
  assets_ = {{"large.obj", large_obj()}};
  arguments_ = {"--metrics", "rendering_time", "--timing-budget", "60"};
  const auto program = start();
  sleep_for(2.5);
  expect_stopped(stop(*program, SIGINT), SIGINT);
  EXPECT_THAT(names_in_folder(), testing::IsEmpty());
  report_stops(1);
}

TEST_F(InterruptsTest, WhileALargePictureIsDrawn) {
  arguments_ = {"--json", "out.json", "--image", "out.png", "--size", "12000x9000"};
  const auto program = start();
  wait_for(*program, [&] { return fs::exists(folder() / "out.json"); });
  sleep_for(0.3);
  const ProgramResult result = stop(*program, SIGTERM);
  EXPECT_EQ(result.exit_code, 143) << result.err;
  EXPECT_THAT(result.err, HasSubstr("stopped after 2 of 2 assets: the report is written, pictures and other "
                                    "files may be missing; 2 assets are kept"));
  EXPECT_THAT(names_in_folder(),
              testing::UnorderedElementsAre("cube.obj.analysis", "leg.obj.analysis", "out.json"));
  report_stops(1);
}

// A device that hangs is no reason to hang.
TEST_F(InterruptsTest, WhileTheDeviceHangs) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto program = start("vkWaitForFences:4+=timeout");
    sleep_for(1.5);
    const ProgramResult result = stop(*program, signal);
    expect_stopped(result, signal);
    EXPECT_THAT(names_in_folder(), testing::IsEmpty());
  }
  report_stops(2);
}

TEST_F(InterruptsTest, TheSecondSignalEndsTheProgramAtOnce) {
  const auto program = start("vkWaitForFences:4+=timeout");
  sleep_for(1.5);
  program->send(SIGINT);
  sleep_for(0.05);
  const auto begin = Clock::now();
  program->send(SIGINT);
  const ProgramResult result = program->wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, testing::Not(HasSubstr("stopped after"))) << "it was not the first signal's end";
  EXPECT_LT(seconds_since(begin), kLongestStop);
}

TEST_F(InterruptsTest, WhatWasFinishedIsKeptAndSaidAndTheNextRunGoesOn) {
  assets_.push_back({"large.obj", large_obj()});
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  const auto program = start();
  wait_for(*program, [&] { return fs::exists(folder() / "leg.obj.analysis"); });
  sleep_for(0.2);
  const ProgramResult result = stop(*program, SIGINT);
  expect_stopped(result, SIGINT);
  EXPECT_THAT(result.err,
              HasSubstr("stopped after 2 of 3 assets: the report is not written; 2 assets are kept "
                        "in their analysis files, from which the same command goes on"));
  EXPECT_EQ(contents("out.json"), "");
  EXPECT_EQ(contents("leg.obj.analysis"), undisturbed("leg.obj.analysis"));
  const ProgramResult again = start_again()->wait();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(contents("out.json"), undisturbed("out.json"));
}

TEST_F(InterruptsTest, NothingIsKeptWithoutAnalysisFiles) {
  arguments_ = {"--no-cache", "--json", "out.json"};
  const auto program = start("vkWaitForFences:12+=timeout");
  sleep_for(2);
  const ProgramResult result = stop(*program, SIGINT);
  expect_stopped(result, SIGINT);
  EXPECT_THAT(result.err, HasSubstr("of 2 assets: the report is not written; no analysis is kept"));
  EXPECT_THAT(names_in_folder(), testing::IsEmpty());
}

// Killed at seeded moments, each time with some analysis files already there: none is ever half written, and
// the next run takes what it finds.
TEST_F(InterruptsTest, KilledAtAnyMoment) {
  const auto begin = Clock::now();
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  const double whole = seconds_since(begin);
  std::mt19937 random(7);
  const int kills = static_cast<int>(fault_runs(30));
  int in_time = 0;
  start()->wait();
  for (int i = 0; i < kills; ++i) {
    SCOPED_TRACE(i);
    fs::remove(folder() / "out.json");
    for (const char* file : {"cube.obj.analysis", "leg.obj.analysis"})
      if (random() % 2 == 0) fs::remove(folder() / file);
    const auto program = start_again();
    sleep_for(std::uniform_real_distribution<double>(0, whole)(random));
    program->send(SIGKILL);
    if (program->wait().exit_code == 128 + SIGKILL) ++in_time;
    for (const std::string& name : names_in_folder())
      if (files::is_temporary_name(name))
        fs::remove(folder() / name);  // as `cache --prune` does
      else
        EXPECT_EQ(contents(name), undisturbed(name)) << name;
  }
  const ProgramResult last = start_again()->wait();
  EXPECT_EQ(last.exit_code, 0);
  EXPECT_THAT(complaints(last), testing::IsEmpty());
  EXPECT_EQ(contents("out.json"), undisturbed("out.json"));
  EXPECT_GT(in_time, 0);
  std::cout << "kills: " << in_time << " of " << kills << " runs were killed before their end\n";
}

}  // namespace
}  // namespace scene_analyzer::faults
