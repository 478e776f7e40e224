// `scene-analyzer analyze` with a mesh that is more than the device can hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "cli/small_device.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// 7200 triangles: three 4-byte numbers each do not fit in what one buffer of the small device can bind.
constexpr std::uint32_t kCells = 60;
static_assert(2 * kCells * kCells * 12 > kSmallDeviceBufferBytes);

class DeviceLimitTest : public testing::Test {
 protected:
  DeviceLimitTest() {
    folder_.write("cube.obj", cube_obj());
    folder_.write("grid.obj", obj_of(cli::flat_grid(kCells), "grid"));
    folder_.write("leg.obj", leg_obj());
  }

  ProgramResult analyze_on_small_device(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    options.environment = {{"VK_ADD_LAYER_PATH", SCENE_ANALYZER_TEST_LAYERS},
                           {"VK_INSTANCE_LAYERS", kSmallDeviceLayer}};
    return run_program(arguments, options);
  }

  TemporaryFolder folder_;
};

TEST_F(DeviceLimitTest, AMeshBeyondTheDeviceIsNamedWithNeedAndLimitAndTheOthersAreRated) {
  const ProgramResult result =
      analyze_on_small_device({"cube.obj", "grid.obj", "leg.obj", "--json", "out.json"});
  EXPECT_EQ(result.exit_code, 3);
  const auto need_and_limit =
      AllOf(HasSubstr("needs buffers for 7200 triangles"),
            HasSubstr(fmt::format("binds at most {} bytes to a buffer", kSmallDeviceBufferBytes)));
  EXPECT_THAT(
      complaints(result),
      ElementsAre(AllOf(StartsWith("warning: grid.obj: mesh 0 (grid) is not analysed: "), need_and_limit)));
  EXPECT_THAT(result.out, AllOf(HasSubstr("cube"), HasSubstr("0.5455"), HasSubstr("grid"), HasSubstr("leg"),
                                HasSubstr("1 mesh not analysed")));

  const json document = json::parse(TemporaryFolder::read(folder_.path() / "out.json"));
  ASSERT_EQ(document["meshes"].size(), 3U);
  const json& grid = document["meshes"][1];
  EXPECT_THAT(grid["not_analysed"].get<std::string>(), need_and_limit);
  EXPECT_TRUE(grid["triangles"].is_null());
  EXPECT_TRUE(grid["aggregate"].is_null());
  for (const auto& [metric, rating] : grid["ratings"].items()) EXPECT_TRUE(rating.is_null()) << metric;
  for (const std::size_t other : {0, 2}) {
    EXPECT_TRUE(document["meshes"][other]["not_analysed"].is_null());
    EXPECT_TRUE(document["meshes"][other]["aggregate"].is_number());
  }
}

TEST_F(DeviceLimitTest, OtherMeshesOfTheSameAssetAreRated) {
  // Vertex numbers go on through a file: the second object counts from the end.
  folder_.write("both.obj", obj_of(cli::flat_grid(kCells), "grid") +
                                "o triangle\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\n");
  const ProgramResult result = analyze_on_small_device({"both.obj", "--json", "-"});
  EXPECT_EQ(result.exit_code, 3);
  const json document = json::parse(result.out);
  ASSERT_EQ(document["meshes"].size(), 2U);
  EXPECT_TRUE(document["meshes"][0]["triangles"].is_null());
  EXPECT_EQ(document["meshes"][1]["triangles"], 1);
}

// Another device may have room, so nothing about the mesh is kept.
TEST_F(DeviceLimitTest, ALargerDeviceAnalysesWhatWasLeftOut) {
  ASSERT_EQ(analyze_on_small_device({"cube.obj", "grid.obj"}).exit_code, 3);
  EXPECT_TRUE(fs::exists(folder_.path() / "cube.obj.analysis"));
  EXPECT_FALSE(fs::exists(folder_.path() / "grid.obj.analysis"));
  ProgramOptions options;
  options.folder = folder_.path();
  const ProgramResult result = run_program({"analyze", "cube.obj", "grid.obj", "--json", "-"}, options);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(complaints(result), IsEmpty());
  EXPECT_EQ(json::parse(result.out)["meshes"][1]["triangles"], 7200);
}

}  // namespace
}  // namespace scene_analyzer
