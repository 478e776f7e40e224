#include "cli/scene_loader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "import/import.h"

namespace scene_analyzer::cli {
namespace {

// Between the analysis and now the file may have been written to.
bool is_what_was_analysed(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis) {
  const auto same = [&](const mesh::Instance& instance, const analysis::InstanceAnalysis& analysed) {
    return scene.meshes[instance.mesh].triangle_count() ==
               analysis.geometries[analysed.geometry].source_triangles &&
           instance.world == analysed.world;
  };
  return std::ranges::equal(scene.instances, analysis.instances, same);
}

}  // namespace

void SceneLoader::add(const analysis::AssetAnalysis& analysis, bool groups,
                      const pipeline::Progress& progress) {
  progress(0, "import for pictures");
  const mesh::Scene scene = import::import_asset(analysis.asset, {}, import::Textures::kDecode);
  if (!is_what_was_analysed(scene, analysis))
    throw InputError(
        fmt::format("{}: it has changed since it was analysed a moment ago; run again", analysis.asset));
  progress(0.5, "upload for pictures");
  if (groups)
    add_with_groups(scene, analysis, progress);
  else
    builder_.add(scene);
}

void SceneLoader::add_with_groups(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis,
                                  const pipeline::Progress& progress) {
  analysis::AssetAnalysis again;
  std::vector<scene_render::GroupShades> shades;
  pipeline::Measurer(device_).measure(
      {.scene = scene,
       .analysis = again,
       .parameters = analysis.parameters,
       .metrics = analysis::MetricSet().set(index_of(analysis::Metric::kPolygonsPerPlanarGroup)),
       .progress = [&](double fraction, const std::string& step) { progress(0.5 + fraction / 2, step); },
       .group_sizes =
           [&](std::uint32_t geometry, const std::vector<std::uint32_t>& sizes) {
             if (shades.size() < again.geometries.size()) shades.resize(again.geometries.size());
             shades[geometry] = scene_render::shade_groups(sizes);
           }});
  shades.resize(again.geometries.size());
  std::vector<const scene_render::GroupShades*> of_instance;
  for (const analysis::InstanceAnalysis& instance : again.instances) {
    const scene_render::GroupShades& known = shades[instance.geometry];
    of_instance.push_back(known.empty() ? nullptr : &known);
  }
  builder_.add(scene, of_instance);
}

}  // namespace scene_analyzer::cli
