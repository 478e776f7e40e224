#include "viewer/reviewed_asset.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include "base/error.h"
#include "gpu/error.h"
#include "pipeline/import_again.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;

// Of an asset's progress: where its analysis and where its import for drawing ends.
constexpr double kAnalysed = 0.7, kImported = 0.85;

pipeline::Progress part_of(const pipeline::Progress& whole, double begin, double end) {
  return [&whole, begin, end](double fraction, const std::string& step) {
    whole(begin + (end - begin) * fraction, step);
  };
}

// What was said of the asset when it was analysed is known.
void add_new_warnings(const mesh::Scene& scene, ReviewedAsset& reviewed) {
  for (const std::string& warning : scene.warnings)
    if (!std::ranges::count(reviewed.analysis.warnings, warning))
      reviewed.messages.push_back(fmt::format("{}: {}", reviewed.analysis.asset, warning));
}

}  // namespace

AssetReviewer::AssetReviewer(pipeline::Options options, gpu::DeviceOptions device)
    : device_options_(std::move(device)),
      limits_(options.import_limits),
      pipeline_(std::move(options), [this]() -> gpu::Device& { return this->device(); }) {}

ReviewedAsset AssetReviewer::review(const fs::path& asset, const pipeline::Progress& progress) {
  pipeline::Outcome outcome = pipeline_.analyze(asset, part_of(progress, 0, kAnalysed));
  ReviewedAsset reviewed;
  reviewed.error = std::move(outcome.error);
  reviewed.messages = std::move(outcome.messages);
  if (!outcome.analysis) return reviewed;
  reviewed.analysis = std::move(*outcome.analysis);
  try {
    load_for_drawing(reviewed, progress);
    measure_groups(reviewed, part_of(progress, kImported, 1));
  } catch (const InputError& error) {
    reviewed.error = error.what();
  } catch (const std::bad_alloc&) {
    reviewed.error = fmt::format("{}: this machine has too little free memory to draw it", asset.string());
  }
  return reviewed;
}

void AssetReviewer::load_for_drawing(ReviewedAsset& reviewed, const pipeline::Progress& progress) {
  progress(kAnalysed, "import for drawing");
  const AssetAnalysis& analysis = reviewed.analysis;
  mesh::Scene scene = pipeline::import_again(analysis, limits_, import::Textures::kDecode);
  add_new_warnings(scene, reviewed);
  reviewed.scene = std::move(scene);
}

void AssetReviewer::measure_groups(ReviewedAsset& reviewed, const pipeline::Progress& progress) {
  progress(0, "planar groups for drawing");
  const AssetAnalysis& analysis = reviewed.analysis;
  reviewed.shades.resize(analysis.geometries.size());
  for (const analysis::InstanceAnalysis& instance : analysis.instances)
    reviewed.shades_of_instance.push_back(instance.geometry);
  const auto has_triangles = [](const mesh::TriangleMesh& mesh) { return mesh.triangle_count() > 0; };
  if (std::ranges::none_of(reviewed.scene.meshes, has_triangles)) return;
  if (!measurer_) measurer_ = std::make_unique<pipeline::Measurer>(device());
  AssetAnalysis again;
  try {
    measurer_->measure(
        {.scene = reviewed.scene,
         .analysis = again,
         .parameters = analysis.parameters,
         .metrics = analysis::MetricSet().set(index_of(analysis::Metric::kPolygonsPerPlanarGroup)),
         .progress = progress,
         .group_sizes = [&](std::uint32_t geometry, const std::vector<std::uint32_t>& sizes) {
           reviewed.shades.at(geometry) = scene_render::shade_groups(sizes);
         }});
  } catch (const gpu::OutOfMemory& error) {
    reviewed.messages.push_back(
        fmt::format("{}: planar groups are not shown: {}", analysis.asset, error.what()));
  }
}

gpu::Device& AssetReviewer::device() {
  if (!device_) device_ = std::make_unique<gpu::Device>(device_options_);
  return *device_;
}

std::vector<std::string> AssetReviewer::take_validation_messages() {
  return device_ ? device_->take_validation_messages() : std::vector<std::string>();
}

}  // namespace scene_analyzer::viewer
