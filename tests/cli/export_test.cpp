// `scene-analyzer analyze --export` as a user runs it; what the file holds is tested in tests/report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/meshes.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class ExportTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }
  json analyzed(const std::string& name) {
    const ProgramResult result = analyze({name, "--no-cache", "--quiet", "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  // The JSON chunk of a GLB file.
  json document(const std::string& name) const {
    const std::string bytes = TemporaryFolder::read(folder_.path() / name);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return json::parse(bytes.substr(20, length));
  }

  TemporaryFolder folder_;
};

TEST_F(ExportTest, TheExportedSceneIsRatedAsTheOriginal) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result =
      analyze({"cube.obj", "leg.obj", "--export", "scene.glb", "--json", "scene.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json original = json::parse(TemporaryFolder::read(folder_.path() / "scene.json")),
             again = analyzed("scene.glb");
  ASSERT_EQ(again["meshes"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again["meshes"][i]["triangles"], original["meshes"][i]["triangles"]);
    for (const char* metric : {"polygons_per_planar_group", "relative_density", "cooccurrence_contrast"})
      EXPECT_NEAR(again["meshes"][i]["ratings"][metric].get<double>(),
                  original["meshes"][i]["ratings"][metric].get<double>(), 1e-6)
          << metric;
  }
  std::vector<json> rows;
  const json exported = document("scene.glb");
  for (const json& node : exported["nodes"])
    if (node.contains("mesh")) rows.push_back(node["extras"]);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["ratings"], original["meshes"][0]["ratings"]);
  EXPECT_EQ(rows[1]["aggregate"], original["meshes"][1]["aggregate"]);
}

TEST_F(ExportTest, ColorsFollowTheMetricAndTheMap) {
  folder_.write("cube.obj", cube_obj());
  std::vector<std::string> files;
  for (const std::vector<std::string>& colors :
       {std::vector<std::string>{}, {"--metric", "fourier_transform"}, {"--colormap", "viridis"}}) {
    std::vector<std::string> arguments = {"cube.obj", "--export", "cube.glb"};
    arguments.insert(arguments.end(), colors.begin(), colors.end());
    ASSERT_EQ(analyze(arguments).exit_code, 0);
    files.push_back(TemporaryFolder::read(folder_.path() / "cube.glb"));
  }
  EXPECT_NE(files[0], files[1]);
  EXPECT_NE(files[0], files[2]);
  EXPECT_NE(files[1], files[2]);
}

TEST_F(ExportTest, WhatCannotBeWrittenIsSaidAndTheTableStays) {
  folder_.write("ball.obj", obj_of(test_meshes::geosphere(8), "ball"));
  fs::create_directory(folder_.path() / "full");
  const SmallDisk disk(folder_.path() / "full", "4k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  const ProgramResult result = analyze({"ball.obj", "--export", "full/ball.glb", "--json", "ball.json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result),
              Contains(AllOf(HasSubstr("ball.glb is not written"), HasSubstr("No space left"))));
  EXPECT_FALSE(fs::exists(folder_.path() / "full" / "ball.glb"));
  EXPECT_TRUE(fs::exists(folder_.path() / "ball.json"));
}

}  // namespace
}  // namespace scene_analyzer
