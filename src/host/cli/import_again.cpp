#include "cli/import_again.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace scene_analyzer::cli {
namespace {

// Between the analysis and now the file may have been written to.
bool is_what_was_analysed(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis) {
  const auto same = [&](const mesh::Instance& instance, const analysis::InstanceAnalysis& analysed) {
    return scene.meshes[instance.mesh].triangle_count() ==
               analysis.geometries[analysed.geometry].source_triangles &&
           std::memcmp(&instance.world, &analysed.world, sizeof instance.world) == 0;  // NaN equals NaN
  };
  return std::ranges::equal(scene.instances, analysis.instances, same);
}

}  // namespace

mesh::Scene import_again(const analysis::AssetAnalysis& analysis, import::Textures textures) {
  mesh::Scene scene = import::import_asset(analysis.asset, {}, textures);
  if (!is_what_was_analysed(scene, analysis))
    throw InputError(
        fmt::format("{}: it has changed since it was analysed a moment ago; run again", analysis.asset));
  return scene;
}

}  // namespace scene_analyzer::cli
