// The device's memory, or the driver's, ends at each of a run's allocations in turn.
#include <cstring>
#include <nlohmann/json.hpp>

#include "faults/fault_test.h"

namespace scene_analyzer::faults {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// What each refusal of memory is called by the one who was refused.
const auto kTellsOfMemory =
    AnyOf(HasSubstr(" memory"), AllOf(HasSubstr(" needs "), HasSubstr(" bytes, but the driver refused it")));

class OutOfMemoryTest : public FaultTest {
 protected:
  void fail_in_turn(const std::string& function, const std::string& calls_from_there,
                    const std::string& fault, std::uint64_t usual) {
    const auto turns = spread_calls(calls(function), fault_runs(usual));
    for (const std::uint64_t call : turns) {
      const std::string rule = function + ":" + std::to_string(call) + calls_from_there + "=" + fault;
      SCOPED_TRACE(rule);
      expect_in_order(run_with(rule));
    }
    report("calls of " + function + ", " + fault + (calls_from_there.empty() ? "" : " from there on"),
           turns.size(), calls(function));
  }

 private:
  void expect_in_order(const ProgramResult& result) {
    if (result.exit_code == 0) return expect_undisturbed(result);
    if (result.exit_code == 2) return expect_nothing(result);
    ASSERT_EQ(result.exit_code, 3) << result.err;
    expect_others_rated(result);
  }

  // A second try was enough.
  void expect_undisturbed(const ProgramResult& result) {
    EXPECT_THAT(complaints(result), IsEmpty());
    expect_files_absent_or_whole();
    EXPECT_EQ(contents("out.json"), undisturbed("out.json"));
  }

  // The device could not be used at all.
  void expect_nothing(const ProgramResult& result) {
    EXPECT_THAT(complaints(result),
                ElementsAre(AllOf(StartsWith("error: "), kTellsOfMemory, HasSubstr("--device"))))
        << result.err;
    EXPECT_EQ(contents("out.json"), "");
    expect_files_absent_or_whole();
  }

  // Pictures and exports show what could be analysed, so their bytes are not the undisturbed run's.
  void expect_whole_files() const {
    const std::string png = contents("out.png"), glb = contents("out.glb");
    EXPECT_TRUE(png.empty() || png.ends_with("IEND\xae\x42\x60\x82"));
    std::uint32_t bytes = 0;
    if (glb.size() >= 12) std::memcpy(&bytes, glb.data() + 8, sizeof bytes);
    EXPECT_EQ(bytes, glb.size());
  }

  // Who has no rating, or no picture, is named with the reason; whoever is not named has all.
  void expect_others_rated(const ProgramResult& result) {
    EXPECT_THAT(complaints(result),
                AllOf(Not(IsEmpty()), Each(kTellsOfMemory),
                      Each(AnyOf(StartsWith("warning: cube.obj: mesh 0 (cube) "),
                                 StartsWith("warning: leg.obj: mesh 0 (leg) "),
                                 StartsWith("error: no picture is drawn: "),
                                 StartsWith("error: out.png is not drawn: "), StartsWith("error: cube.obj: "),
                                 StartsWith("error: leg.obj: ")))))
        << result.err;
    expect_whole_files();
    const json now = json::parse(contents("out.json")), before = json::parse(undisturbed("out.json"));
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string& asset = assets_[i].first;
      if (result.err.find(asset) != std::string::npos) continue;
      ASSERT_EQ(now["meshes"].size(), 2U);
      EXPECT_EQ(now["meshes"][i]["triangles"], before["meshes"][i]["triangles"]);
      EXPECT_EQ(contents(asset + ".analysis"), undisturbed(asset + ".analysis"));
    }
  }
};

TEST_F(OutOfMemoryTest, OfTheDeviceOnce) {
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  fail_in_turn("vkAllocateMemory", "", "out_of_device_memory", 20);
}

TEST_F(OutOfMemoryTest, OfTheDeviceFromThereOn) {
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  fail_in_turn("vkAllocateMemory", "+", "out_of_device_memory", 6);
}

TEST_F(OutOfMemoryTest, OfTheDriver) {
  run_undisturbed({"--json", "out.json"}, {"out.json"});
  for (const char* function : {"vkCreateDevice", "vkCreateFence", "vkCreateCommandPool",
                               "vkCreatePipelineCache", "vkCreateComputePipelines", "vkCreateShaderModule",
                               "vkAllocateCommandBuffers", "vkBeginCommandBuffer", "vkEndCommandBuffer",
                               "vkCreateBuffer", "vkMapMemory", "vkAllocateMemory", "vkQueueSubmit2"})
    fail_in_turn(function, "", "out_of_host_memory", 2);
}

TEST_F(OutOfMemoryTest, WhileDrawingAndExporting) {
  run_undisturbed({"--json", "out.json", "--image", "out.png", "--size", "240x120", "--export", "out.glb"},
                  {"out.json", "out.png", "out.glb"});
  fail_in_turn("vkAllocateMemory", "", "out_of_device_memory", 20);
  for (const char* function : {"vkCreateImage", "vkCreateImageView", "vkCreateGraphicsPipelines"})
    fail_in_turn(function, "", "out_of_host_memory", 3);
}

}  // namespace
}  // namespace scene_analyzer::faults
