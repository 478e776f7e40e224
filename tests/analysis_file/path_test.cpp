#include <set>

#include "analysis_file/sample.h"

namespace scene_analyzer::analysis_file {
namespace {

using Place = FolderTest;

TEST_F(Place, BesideTheAsset) {
  EXPECT_EQ(path_for("models/chair.obj", std::nullopt), "models/chair.obj.analysis");
  EXPECT_EQ(path_for("chair.obj", std::nullopt), "chair.obj.analysis");
}

TEST_F(Place, BelowTheCacheUnderTheCanonicalPath) {
  fs::create_directories(folder / "real/sub");
  fs::create_directory_symlink(folder / "real", folder / "link");
  write_text(folder / "real/a.obj", "x");
  const fs::path cache = folder / "cache";
  const fs::path expected = cache / (folder / "real/a.obj.analysis").relative_path();
  EXPECT_EQ(path_for(folder / "real/a.obj", cache), expected);
  EXPECT_EQ(path_for(folder / "link/a.obj", cache), expected);
  EXPECT_EQ(path_for(folder / "real/sub/.././a.obj", cache), expected);
}

TEST_F(Place, NothingClimbsOutOfTheCache) {
  const std::string cache = (folder / "cache").string();
  for (const char* asset : {"../../../../../../../../etc/x.obj", "/../../x.obj", "a/../../../b/x.obj"}) {
    const std::string place = path_for(asset, cache).string();
    EXPECT_TRUE(place.starts_with(cache + "/")) << place;
    EXPECT_EQ(place.find(".."), std::string::npos) << place;
  }
}

TEST_F(Place, NoTwoAssetsShareAPlace) {
  const std::string longest(255, 'n');
  const std::string shortened = path_for("/x/" + longest, "/c").filename().string();
  std::vector<std::string> assets = {"/x/a",
                                     "/x/a.obj",
                                     "/x/b/a.obj",
                                     "/x/a.analysis",
                                     "/x/a.analysis/m",
                                     "/x/a.analysis.d/m",
                                     "/x/a.analysis.d.d/m",
                                     "/x/a.d/m",
                                     "/x/" + longest,
                                     "/x/" + longest.substr(1),
                                     "/x/" + longest.substr(9),
                                     "/x/" + longest + "/m",
                                     "/x/" + shortened.substr(0, shortened.size() - 9)};
  std::set<fs::path> places;
  for (const auto& asset : assets) {
    const fs::path place = path_for(asset, "/c");
    for (const auto& component : place) EXPECT_LE(component.string().size(), 255u);
    places.insert(place);
  }
  EXPECT_EQ(places.size(), assets.size());
}

// Not only different names: all of them can lie on one disk at once.
TEST_F(Place, AllPlacesCanExistTogether) {
  for (const char* asset : {"/x/a", "/x/a.analysis/m", "/x/a.analysis.d/m", "/x/a.analysis"})
    store(path_for(asset, folder), full_analysis());
  store(path_for("/x/" + std::string(255, 'n'), folder), full_analysis());
  for (const char* asset : {"/x/a", "/x/a.analysis/m", "/x/a.analysis.d/m", "/x/a.analysis"})
    EXPECT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(load(path_for(asset, folder)))) << asset;
}

TEST_F(Place, LongNamesAreCutBetweenCharacters) {
  std::string name;
  while (name.size() < 250) name += "\xe2\x82\xac";
  const std::string place = path_for(name, std::nullopt).string();
  EXPECT_LE(place.size(), 255u);
  const std::string kept = place.substr(0, place.find('~'));
  EXPECT_EQ(kept.size() % 3, 0u);
  EXPECT_EQ(kept, name.substr(0, kept.size()));
  EXPECT_TRUE(place.ends_with(".analysis"));
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
