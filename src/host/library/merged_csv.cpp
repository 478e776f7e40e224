// merged_csv.cpp — The table of all meshes, asset by asset, so that no more than one analysis is in memory.
#include <cstddef>

#include "library/load_record.h"
#include "library/merge.h"

namespace scene_analyzer::library {
namespace {

// The facts of an asset's meshes, and the ratings that the library gives them. `first` is the first of them
// in `merged`.
ratings::SceneRating rating_of(const analysis::AssetAnalysis& analysis, const Merged& merged,
                               std::size_t first) {
  ratings::SceneRating scene = ratings::rate(std::span(&analysis, 1), {});
  scene.timing = merged.timing;
  scene.signed_aggregate = merged.signed_aggregate;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    ratings::MeshRating& mesh = scene.meshes[i];
    mesh.distance.reset();
    mesh.ratings = merged.ratings[first + i];
    mesh.relative_ratings = merged.relative_ratings[first + i];
    mesh.aggregate = merged.aggregates[first + i];
  }
  return scene;
}

}  // namespace

void write_csv(const std::filesystem::path& folder, const Merged& merged, const report::Sink& sink) {
  sink(report::csv_header());
  std::size_t number = 0;
  for (std::size_t asset = 0; asset < merged.assets.size(); ++asset) {
    const analysis::AssetAnalysis analysis = load_merged(folder, merged, asset);
    report::SceneReport report;
    report.parameters = merged.manifest.parameters;
    report.assets = std::span(&analysis, 1);
    report.rating = rating_of(analysis, merged, number);
    for (std::size_t mesh = 0; mesh < report.rating.meshes.size(); ++mesh)
      sink(report::csv_line(report, mesh, number++));
  }
}

}  // namespace scene_analyzer::library
