// scene_loader.h — Analysed assets as one scene on the device.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analysis.h"
#include "import/import.h"
#include "pipeline/measure.h"
#include "scene_render/scene_model_builder.h"

namespace scene_analyzer::pictures {

// Appends one asset to a scene that is to be drawn.
class SceneLoader {
 public:
  SceneLoader(gpu::Device& device, const import::Limits& limits)
      : device_(device), limits_(limits), builder_(device) {}

  // Imports `analysis.asset`, with textures. `groups`: with planar groups, which are measured anew, as no
  // analysis file holds them. Throws InputError, also when the asset is no longer what was analysed;
  // gpu::OutOfMemory where planar groups are measured; gpu::DeviceLost.
  void add(const analysis::AssetAnalysis& analysis, bool groups, const pipeline::Progress& progress);
  // The same of an asset that was imported with its textures; its instances run along those of the analysis.
  void add(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis, bool groups,
           const pipeline::Progress& progress);

  scene_render::SceneModel finish();

  // What was said about textures and about what does not fit on the device, since the last call.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  void add_with_groups(const mesh::Scene& scene, const analysis::AssetAnalysis& analysis,
                       const pipeline::Progress& progress);

  gpu::Device& device_;
  const import::Limits& limits_;
  scene_render::SceneModelBuilder builder_;
  std::optional<pipeline::Measurer> measurer_;  // of planar groups
  std::vector<std::string> warnings_;
};

}  // namespace scene_analyzer::pictures
