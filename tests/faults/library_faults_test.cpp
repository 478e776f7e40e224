// A library is analysed while the device is lost or out of memory: other assets go on, and nothing is lost.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "cli/assets.h"
#include "faults/fault_rules.h"
#include "faults/fault_test.h"

namespace scene_analyzer::faults {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr int kAssets = 8;

class LibraryFaultTest : public testing::Test {
 protected:
  LibraryFaultTest() {
    std::filesystem::create_directory(folder_.path() / "library");
    for (int i = 0; i < kAssets; ++i)
      folder_.write(fmt::format("library/{}.obj", i), obj_of(cli::prism(3 + i, 1, 0.1 + i, 1), "prism"));
  }

  ProgramResult batch(const std::string& out, std::map<std::string, std::string> environment) {
    environment["VK_ADD_LAYER_PATH"] = SCENE_ANALYZER_TEST_LAYERS;
    environment["VK_INSTANCE_LAYERS"] = kFaultLayer;
    return run_program({"batch", "library", "--out", out, "--metrics", kUntimedMetrics},
                       {.environment = std::move(environment), .folder = folder_.path(), .terminal = false});
  }
  ProgramResult batch_with(const std::string& out, const std::string& rule) {
    return batch(out, {{kRulesVariable, rule}});
  }
  ProgramResult merge(const std::string& out) {
    return run_program({"merge", out, "--csv", "-"},
                       {.environment = {}, .folder = folder_.path(), .terminal = false});
  }
  std::string merged(const std::string& out) {
    const ProgramResult result = merge(out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
  // How often an undisturbed run, into "whole", calls a function.
  std::uint64_t calls(const std::string& function) {
    const auto counts = folder_.path() / "counts";
    EXPECT_EQ(batch("whole", {{kCountsVariable, counts.string()}}).exit_code, 0);
    std::istringstream lines(TemporaryFolder::read(counts));
    std::string name;
    for (std::uint64_t count = 0; lines >> name >> count;)
      if (name == function) return count;
    ADD_FAILURE() << "the layer was not there";
    return 0;
  }
  void fail_at_each(const std::string& function, const std::string& fault, std::uint64_t usual) {
    const std::uint64_t all = calls(function);
    const auto turns = spread_calls(all, fault_runs(usual));
    for (const std::uint64_t call : turns) {
      SCOPED_TRACE(fmt::format("{} {}", function, call));
      const std::string out = fmt::format("out{}", call);
      const ProgramResult result = batch_with(out, fmt::format("{}:{}={}", function, call, fault));
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_THAT(result.out, StartsWith("8 assets: 8 analysed; "));
      EXPECT_EQ(merged(out), merged("whole"));
    }
    std::cout << "failed in turn: " << turns.size() << " of " << all << " calls of " << function << '\n';
  }

  TemporaryFolder folder_;
};

TEST_F(LibraryFaultTest, ALostDeviceIsReplaced) {
  fail_at_each("vkQueueSubmit2", "device_lost", 4);
}

TEST_F(LibraryFaultTest, ADeviceThatIsLostTimeAndAgainEndsTheRunAndTheNextGoesOn) {
  calls("vkQueueSubmit2");
  const ProgramResult result = batch_with("out", "vkQueueSubmit2:2+=device_lost");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("error: the GPU was lost while "));
  EXPECT_EQ(merge("out").exit_code, 1);
  EXPECT_EQ(batch_with("out", "").exit_code, 0);
  EXPECT_EQ(merged("out"), merged("whole"));
}

TEST_F(LibraryFaultTest, WhatDoesNotFitIsTriedAgainAlone) {
  fail_at_each("vkAllocateMemory", "out_of_device_memory", 4);
}

}  // namespace
}  // namespace scene_analyzer::faults
