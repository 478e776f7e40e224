#include "pipeline/import_again.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace scene_analyzer::pipeline {
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

// As the analysis of an asset without any mesh has a row, so has the scene.
void add_row_to_empty(mesh::Scene& scene) {
  if (!scene.instances.empty()) return;
  scene.materials.resize(1);
  scene.meshes.resize(1);
  scene.instances.resize(1);
}

}  // namespace

mesh::Scene import_again(const analysis::AssetAnalysis& analysis, const import::Limits& limits,
                         import::Textures textures) {
  mesh::Scene scene = import::import_asset(analysis.asset, limits, textures);
  check_is_what_was_analysed(scene, analysis);
  return scene;
}

void check_is_what_was_analysed(mesh::Scene& scene, const analysis::AssetAnalysis& analysis) {
  add_row_to_empty(scene);
  if (!is_what_was_analysed(scene, analysis))
    throw InputError(
        fmt::format("{}: it has changed since it was analysed; analyse it again", analysis.asset));
}

}  // namespace scene_analyzer::pipeline
