// reviewed_asset.h — One asset on its way into the review window: analysed, and imported to be drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "import/import.h"
#include "mesh/scene.h"
#include "pipeline/pipeline.h"
#include "scene_render/scene_model.h"

namespace scene_analyzer::viewer {

// What became of one asset. Where `error` is not empty, nothing else but `asset` and `messages` means
// anything.
struct ReviewedAsset {
  std::size_t asset = 0;  // place in the order given
  std::string error;      // names the file and the reason
  analysis::AssetAnalysis analysis;
  // With decoded textures. Its instances are those of the analysis, in the same order: an asset without any
  // mesh has an instance of an empty one.
  mesh::Scene scene;
  // Per geometry of the analysis; empty where the device could not group its triangles.
  std::vector<scene_render::GroupShades> shades;
  std::vector<std::uint32_t> shades_of_instance;  // along scene.instances: index into `shades`
  std::vector<std::string> messages;              // for the log, at warning level
};

// Makes reviewed assets, one after the other. Belongs to one thread, as its device does.
class AssetReviewer {
 public:
  // The device is made when it is first needed.
  AssetReviewer(pipeline::Options options, gpu::DeviceOptions device);

  // Throws gpu::NoDevice and gpu::DeviceLost, and what `progress` throws; a bad asset is no exception. Cost:
  // that of Pipeline::analyze, a second import, and the measuring of planar groups, which no file keeps.
  // Memory: while it runs, the scene of the analysis; then the scene with its textures, and a byte per
  // triangle.
  ReviewedAsset review(const std::filesystem::path& asset, const pipeline::Progress& progress);

  // Of the device; empty when there is none or it has no validation layer.
  std::vector<std::string> take_validation_messages();

 private:
  gpu::Device& device();
  void load_for_drawing(ReviewedAsset& reviewed, const pipeline::Progress& progress);
  void measure_groups(ReviewedAsset& reviewed, const pipeline::Progress& progress);

  gpu::DeviceOptions device_options_;
  import::Limits limits_;
  std::unique_ptr<gpu::Device> device_;
  pipeline::Pipeline pipeline_;
  std::unique_ptr<pipeline::Measurer> measurer_;  // of planar groups alone
};

}  // namespace scene_analyzer::viewer
