// `scene-analyzer analyze --image` and `--image-set` as a user runs them, and the pictures they write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/png.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using test::decode_png;
using test::Png;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PicturesTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }
  Png picture(const std::string& name) const {
    return decode_png(TemporaryFolder::read(folder_.path() / name));
  }

  TemporaryFolder folder_;
};

// Neither white nor of the legend.
std::vector<std::array<int, 3>> drawn_pixels(const Png& png) {
  std::vector<std::array<int, 3>> drawn;
  for (int y = 0; y < png.height * 4 / 5; ++y)
    for (int x = 0; x < png.width; ++x)
      if (png.at(x, y) != std::array{255, 255, 255}) drawn.push_back(png.at(x, y));
  return drawn;
}

TEST_F(PicturesTest, AMeshHasTheColorOfItsRating) {
  folder_.write("cube.obj", cube_obj());
  const ProgramResult result = analyze(
      {"cube.obj", "--image", "cube.png", "--metric", "polygons_per_planar_group", "--size", "300x200"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("cube")) << "the table is still there";
  const Png png = picture("cube.png");
  EXPECT_EQ(png.width, 300);
  EXPECT_EQ(png.height, 200);
  const std::vector<std::array<int, 3>> drawn = drawn_pixels(png);
  ASSERT_GT(drawn.size(), 2000U);
  // 6 / 11 lies beyond yellow: red, and 10 / 11 of it green, on all sides of the cube.
  std::size_t right = 0;
  for (const auto& pixel : drawn)
    right += pixel[2] == 0 && std::abs(pixel[1] - pixel[0] * 10.0 / 11) < 2 ? 1 : 0;
  EXPECT_GT(right, drawn.size() * 9 / 10) << "but for smoothed edges";
}

TEST_F(PicturesTest, MaterialsLendTheirLuminance) {
  folder_.write("cube.mtl", "newmtl paint\nKd 0.2 0.4 0.8\n");
  folder_.write("cube.obj", "mtllib cube.mtl\nusemtl paint\n" + cube_obj());
  ASSERT_EQ(analyze({"cube.obj", "--image", "cube.png", "--metric", "polygons_per_planar_group"}).exit_code,
            0);
  const double luminance = 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.8;
  const std::vector<std::array<int, 3>> drawn = drawn_pixels(picture("cube.png"));
  std::size_t right = 0;
  for (const auto& pixel : drawn)
    right += std::abs(pixel[1] - pixel[0] * (10.0 / 11 + luminance) / (1 + luminance)) < 2 &&
                     std::abs(pixel[2] - pixel[0] * luminance / (1 + luminance)) < 2
                 ? 1
                 : 0;
  EXPECT_GT(right, drawn.size() * 9 / 10);
}

TEST_F(PicturesTest, TheSetHasEveryMetricTwice) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("leg.obj", leg_obj());
  const ProgramResult result =
      analyze({"cube.obj", "leg.obj", "--image-set", "set", "--size", "240x160", "--image", "one.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "set"))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  EXPECT_THAT(
      names,
      ElementsAre("aggregate-relative.png", "aggregate.png", "cooccurrence_contrast-relative.png",
                  "cooccurrence_contrast.png", "distance-relative.png", "distance.png",
                  "fourier_transform-relative.png", "fourier_transform.png", "own_colours.png",
                  "planar_group_variation-relative.png", "planar_group_variation.png", "planar_groups.png",
                  "polygons_per_planar_group-relative.png", "polygons_per_planar_group.png",
                  "relative_density-relative.png", "relative_density.png"));
  for (const std::string& name : names) EXPECT_FALSE(drawn_pixels(picture("set/" + name)).empty()) << name;
  EXPECT_EQ(picture("one.png").pixels, picture("set/aggregate.png").pixels);
  EXPECT_NE(picture("set/aggregate-relative.png").pixels, picture("set/aggregate.png").pixels);
}

TEST_F(PicturesTest, NothingIsDrawnOfNothingAndTheTableStays) {
  folder_.write("flat.obj", "o line\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const ProgramResult result = analyze({"flat.obj", "--image", "flat.png", "--json", "flat.json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result),
              testing::Contains(HasSubstr("no picture is drawn: the scene has no triangle")));
  EXPECT_FALSE(fs::exists(folder_.path() / "flat.png"));
  EXPECT_TRUE(fs::exists(folder_.path() / "flat.json"));
}

TEST_F(PicturesTest, BrokenTexturesAreAWarningOnly) {
  folder_.write("square.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd broken.png\n");
  folder_.write("broken.png", "this is no picture");
  folder_.write(
      "square.obj",
      "mtllib square.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
  const ProgramResult result = analyze({"square.obj", "--image", "square.png"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(complaints(result), testing::Contains(HasSubstr("broken.png")));
  EXPECT_FALSE(drawn_pixels(picture("square.png")).empty());
}

TEST_F(PicturesTest, AMeshFarAwayIsNamed) {
  std::string text;
  for (const char* x : {"0", "3", "6", "9e6"}) {
    text += fmt::format("o at_{}\nv {} 0 0\nv {} 0 1\nv {} 1 0\nf -3 -2 -1\n", x, x, x, x);
  }
  folder_.write("far.obj", text);
  const ProgramResult result = analyze({"far.obj", "--image", "far.png"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(complaints(result), ElementsAre(AllOf(HasSubstr("at_9e6"), HasSubstr("--target"))));
  const ProgramResult chosen =
      analyze({"far.obj", "--image", "far.png", "--eye", "12,3,8", "--target", "3,0,0"});
  EXPECT_THAT(complaints(chosen), IsEmpty());
  EXPECT_GT(drawn_pixels(picture("far.png")).size(), 300U);
}

TEST_F(PicturesTest, AnAssetWithoutMeshesTakesNoPictureAway) {
  folder_.write("cube.obj", cube_obj());
  folder_.write("empty.gltf",
                R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"n"}]})");
  const ProgramResult result =
      analyze({"cube.obj", "empty.gltf", "--image", "both.png", "--export", "both.glb"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(drawn_pixels(picture("both.png")).empty());
  EXPECT_TRUE(fs::exists(folder_.path() / "both.glb"));
}

TEST_F(PicturesTest, FilesThatCannotBeWrittenAreNamedAndOthersAreWritten) {
  folder_.write("cube.obj", cube_obj());
  fs::create_directories(folder_.path() / "set" / "distance.png");
  const ProgramResult result = analyze({"cube.obj", "--image-set", "set", "--size", "240x120"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result), ElementsAre(AllOf(HasSubstr("cannot write"), HasSubstr("distance.png"))));
  EXPECT_TRUE(fs::exists(folder_.path() / "set" / "own_colours.png"));
}

// The demo scene against pictures that a person has looked at. SCENE_ANALYZER_UPDATE_GOLDEN=1 writes them
// anew.
class GoldenTest : public PicturesTest {
 protected:
  static fs::path golden(const std::string& name) {
    return fs::path(SCENE_ANALYZER_SOURCE_DIR) / "tests/cli/golden" / (name + ".png");
  }

  void compare(const std::string& name, std::vector<std::string> more) {
    const std::string scene = std::string(SCENE_ANALYZER_SOURCE_DIR) + "/examples/living-room.glb";
    std::vector<std::string> arguments = {scene,     "--cache-dir", "cache",      "--size",
                                          "480x300", "--image",     name + ".png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(analyze(arguments).exit_code, 0);
    const std::string bytes = TemporaryFolder::read(folder_.path() / (name + ".png"));
    ASSERT_EQ(analyze(arguments).exit_code, 0);
    EXPECT_EQ(bytes, TemporaryFolder::read(folder_.path() / (name + ".png"))) << "the same twice";
    if (std::getenv("SCENE_ANALYZER_UPDATE_GOLDEN") != nullptr)
      fs::copy_file(folder_.path() / (name + ".png"), golden(name), fs::copy_options::overwrite_existing);
    expect_alike(decode_png(bytes), decode_png(TemporaryFolder::read(golden(name))));
  }

  // Devices differ at edges; fonts differ in the legend, which is not compared.
  static void expect_alike(const Png& drawn, const Png& expected) {
    ASSERT_EQ(drawn.width, expected.width);
    ASSERT_EQ(drawn.height, expected.height);
    const int rows = expected.height - expected.height / 9;
    std::size_t different = 0;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < expected.width; ++x)
        for (std::size_t i = 0; i < 3; ++i)
          if (std::abs(drawn.at(x, y)[i] - expected.at(x, y)[i]) > 12) {
            ++different;
            break;
          }
    EXPECT_LT(different, static_cast<std::size_t>(rows) * static_cast<std::size_t>(expected.width) / 200);
  }
};

TEST_F(GoldenTest, DemoSceneAggregate) {
  compare("aggregate", {});
}
TEST_F(GoldenTest, DemoSceneDensityWithExtremes) {
  compare("density-extremes",
          {"--metric", "relative_density", "--emphasis", "extremes", "--colormap", "viridis"});
}
TEST_F(GoldenTest, DemoScenePlanarGroups) {
  compare("planar-groups", {"--metric", "planar_groups"});
}
TEST_F(GoldenTest, DemoSceneFromWithin) {
  compare("from-within",
          {"--eye", "1.5,1.2,1.5", "--target", "-1,0.5,-1", "--metric", "polygons_per_planar_group"});
}

}  // namespace
}  // namespace scene_analyzer
