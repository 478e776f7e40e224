// The device is lost at each of a run's submissions and waits in turn.
#include <nlohmann/json.hpp>

#include "faults/fault_test.h"

namespace scene_analyzer::faults {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class DeviceLostTest : public FaultTest {
 protected:
  void lose_at_each(const std::string& function, std::uint64_t usual) {
    const auto turns = spread_calls(calls(function), fault_runs(usual));
    for (const std::uint64_t call : turns) {
      SCOPED_TRACE(function + " " + std::to_string(call));
      const ProgramResult result = run_with(function + ":" + std::to_string(call) + "=device_lost");
      EXPECT_EQ(result.exit_code, 2);
      EXPECT_THAT(complaints(result),
                  ElementsAre(AllOf(StartsWith("error: the GPU was lost while "), HasSubstr("Start again"),
                                    HasSubstr("--device"), HasSubstr(" of 2 assets: the report is "))))
          << result.err;
      expect_files_absent_or_whole();
    }
    report("calls of " + function, turns.size(), calls(function));
  }
};

TEST_F(DeviceLostTest, WhileMeasuring) {
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  lose_at_each("vkQueueSubmit2", 100);
  lose_at_each("vkWaitForFences", 5);
}

TEST_F(DeviceLostTest, WhileDrawingAndExporting) {
  run_undisturbed({"--json", "out.json", "--image", "out.png", "--size", "240x120", "--export", "out.glb"},
                  {"out.json", "out.png", "out.glb"});
  lose_at_each("vkQueueSubmit2", 100);
}

// Rendering times differ from run to run, and how many submissions there are with them; nothing is stored
// before they are there.
TEST_F(DeviceLostTest, WhileTiming) {
  run_undisturbed({"--timing-budget", "0.2", "--steps", "2"}, {});
  const std::uint64_t all = calls("vkQueueSubmit2");
  const auto turns = spread_calls(all / 2, fault_runs(5));
  for (const std::uint64_t call : turns) {
    SCOPED_TRACE(call);
    const ProgramResult result = run_with("vkQueueSubmit2:" + std::to_string(call) + "=device_lost");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(complaints(result), ElementsAre(StartsWith("error: the GPU was lost while "))) << result.err;
  }
  report("submissions with rendering times, of which there are about", turns.size(), all);
}

// The first asset's analysis is there when the device is lost at the last submission, and the next run only
// measures the second.
TEST_F(DeviceLostTest, WhatWasFinishedIsKeptAndSaid) {
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  const std::string last = std::to_string(calls("vkQueueSubmit2"));
  const ProgramResult result = run_with("vkQueueSubmit2:" + last + "=device_lost");
  EXPECT_THAT(result.err,
              HasSubstr("ended after 1 of 2 assets: the report is not written; 1 asset is kept in "
                        "its analysis file"));
  EXPECT_EQ(contents("cube.obj.analysis"), undisturbed("cube.obj.analysis"));
  EXPECT_EQ(contents("leg.obj.analysis"), "");
  EXPECT_EQ(contents("out.json"), "");
}

}  // namespace
}  // namespace scene_analyzer::faults
