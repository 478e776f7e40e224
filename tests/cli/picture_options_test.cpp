#include "cli/picture_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "cli/analyze_options.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::cli {
namespace {

using pictures::Subject;
using testing::AllOf;
using testing::HasSubstr;

AnalyzeRequest parse(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "room.glb");
  return parse_analyze(arguments);
}

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused: " << testing::PrintToString(arguments);
  return "";
}

TEST(PictureOptions, NothingIsDrawnUnlessAskedFor) {
  EXPECT_FALSE(parse({}).pictures.wanted());
}

TEST(PictureOptions, APictureShowsTheAggregateByDefault) {
  const PictureRequest request = parse({"--image", "a.png"}).pictures;
  EXPECT_TRUE(request.wanted());
  EXPECT_EQ(request.image, "a.png");
  EXPECT_FALSE(request.image_set);
  EXPECT_EQ(request.content.subject, Subject::kAggregate);
  EXPECT_EQ(request.content.map, ratings::ColorMap::kThesis);
  EXPECT_FALSE(request.content.relative);
  EXPECT_FALSE(request.content.emphasize_extremes);
  EXPECT_EQ(request.format.width, 1280U);
  EXPECT_EQ(request.format.height, 720U);
  EXPECT_FALSE(request.format.target);
}

TEST(PictureOptions, EveryOptionArrives) {
  const AnalyzeRequest request =
      parse({"--image", "a.png", "--metric", "relative_density", "--colormap", "coolwarm", "--size",
             "640x400", "--eye", "1,2,3", "--target", "4,5,6", "--emphasis", "extremes", "--relative"});
  const PictureRequest& pictures = request.pictures;
  EXPECT_EQ(pictures.content.subject, Subject::kMetric);
  EXPECT_EQ(pictures.content.metric, analysis::Metric::kRelativeDensity);
  EXPECT_EQ(pictures.content.map, ratings::ColorMap::kCoolwarm);
  EXPECT_TRUE(pictures.content.relative);
  EXPECT_TRUE(pictures.content.emphasize_extremes);
  EXPECT_EQ(pictures.format.width, 640U);
  EXPECT_EQ(pictures.format.height, 400U);
  EXPECT_EQ(pictures.format.target, (mesh::Vector3{4, 5, 6}));
  EXPECT_EQ(request.ratings.eye, (mesh::Vector3{1, 2, 3}));
  const std::vector<std::pair<std::string, ratings::ColorMap>> maps = {
      {"thesis", ratings::ColorMap::kThesis},
      {"viridis", ratings::ColorMap::kViridis},
      {"cividis", ratings::ColorMap::kCividis}};
  for (const auto& [name, map] : maps)
    EXPECT_EQ(parse({"--image-set", "set", "--colormap", name}).pictures.content.map, map);
  EXPECT_EQ(parse({"--image", "a.png", "--metric", "planar_groups"}).pictures.content.subject,
            Subject::kPlanarGroups);
  EXPECT_EQ(parse({"--image-set", "set"}).pictures.image_set, "set");
  const AnalyzeRequest exported =
      parse({"--export", "a.glb", "--metric", "distance", "--colormap", "cividis"});
  EXPECT_EQ(exported.export_file, "a.glb");
  EXPECT_EQ(exported.pictures.content.metric, analysis::Metric::kDistance);
  EXPECT_FALSE(exported.pictures.wanted());
}

TEST(PictureOptions, WrongOnesAreRefusedWithARemedy) {
  EXPECT_THAT(refusal({"--image", "a.jpg"}), AllOf(HasSubstr("a.jpg"), HasSubstr(".png")));
  EXPECT_THAT(refusal({"--image", ""}), HasSubstr(".png"));
  EXPECT_THAT(refusal({"--image", "none/a.png"}), HasSubstr("'none' does not exist"));
  EXPECT_THAT(refusal({"--image", "a.png", "--json", "./a.png"}),
              HasSubstr("--json and --image name the same file"));
  EXPECT_THAT(refusal({"--image", "a.png", "--metric", "relative_densty"}),
              AllOf(HasSubstr("aggregate"), HasSubstr("did you mean relative_density?")));
  EXPECT_THAT(refusal({"--image", "a.png", "--metrics", "distance", "--metric", "fourier_transform"}),
              HasSubstr("--metrics"));
  EXPECT_THAT(refusal({"--image", "a.png", "--colormap", "virids"}), HasSubstr("did you mean viridis?"));
  EXPECT_THAT(refusal({"--image", "a.png", "--emphasis", "all"}), HasSubstr("extremes"));
  EXPECT_THAT(refusal({"--image", "a.png", "--metric", "planar_groups", "--emphasis", "extremes"}),
              HasSubstr("another --metric"));
  EXPECT_THAT(refusal({"--image", "a.png", "--size", "200x720"}), HasSubstr("at least 240 x 120"));
  EXPECT_THAT(refusal({"--image", "a.png", "--size", "wide"}), HasSubstr("--size"));
  EXPECT_THAT(refusal({"--image", "a.png", "--target", "1,2"}), HasSubstr("--target"));
  EXPECT_THAT(refusal({"--image-set", "set", "--metric", "distance"}),
              HasSubstr("--image-set shows everything"));
  EXPECT_THAT(refusal({"--image", "set/aggregate.png", "--image-set", "./set/"}),
              HasSubstr("choose another place"));
  EXPECT_THAT(refusal({"--image-set", ""}), HasSubstr("needs a folder"));
  const TemporaryFolder folder;
  const auto file = folder.write("file", "");
  EXPECT_THAT(refusal({"--image-set", file.string()}), HasSubstr("is a file"));
  for (const char* option : {"--size", "--target", "--emphasis"})
    EXPECT_THAT(refusal({"--export", "a.glb", option, "viridis"}),
                HasSubstr("add --image FILE.png or --image-set DIR"))
        << option;
  for (const char* option : {"--metric", "--colormap"})
    EXPECT_THAT(refusal({option, "viridis"}), HasSubstr("or --export FILE.glb")) << option;
  EXPECT_THAT(refusal({"--export", "a.gltf"}), AllOf(HasSubstr("a.gltf"), HasSubstr(".glb")));
  EXPECT_THAT(refusal({"--export", "none/a.glb"}), HasSubstr("'none' does not exist"));
  EXPECT_THAT(refusal({"--export", "a.glb", "--metric", "planar_groups"}), HasSubstr("one colour per mesh"));
}

}  // namespace
}  // namespace scene_analyzer::cli
