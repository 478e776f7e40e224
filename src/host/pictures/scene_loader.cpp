#include "pictures/scene_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "pipeline/import_again.h"

namespace scene_analyzer::pictures {

void SceneLoader::add(const analysis::AssetAnalysis& analysis, bool groups,
                      const pipeline::Progress& progress) {
  progress(0, "import for pictures");
  add(pipeline::import_again(analysis, limits_, import::Textures::kDecode), analysis, groups, progress);
}

void SceneLoader::add(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis, bool groups,
                      const pipeline::Progress& progress) {
  // What the analysis has said is known.
  for (const std::string& warning : scene.warnings)
    if (!std::ranges::count(analysis.warnings, warning))
      warnings_.push_back(fmt::format("{}: {}", analysis.asset, warning));
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
  if (!measurer_) measurer_.emplace(device_);
  measurer_->measure(
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

scene_render::SceneModel SceneLoader::finish() {
  scene_render::SceneModel model = builder_.finish();
  std::ranges::move(builder_.take_warnings(), std::back_inserter(warnings_));
  return model;
}

}  // namespace scene_analyzer::pictures
