#include "viewer/reviewed_scene.h"

#include <algorithm>
#include <iterator>

#include "base/version.h"

namespace scene_analyzer::viewer {

void ReviewedScene::append(const ReviewJob::Finished& asset) {
  std::vector<const scene_render::GroupShades*> groups;
  for (const std::uint32_t geometry : asset.shades_of_instance) {
    const auto& shades = asset.shades[geometry];
    groups.push_back(shades.empty() ? nullptr : &shades);
  }
  builder_.add(asset.scene, groups);
  assets_.push_back(asset.analysis);
}

ReviewedScene::Arrived ReviewedScene::add(const std::vector<ReviewJob::Finished>& assets) {
  Arrived arrived;
  for (const ReviewJob::Finished& asset : assets) {
    std::ranges::copy(asset.messages, std::back_inserter(arrived.messages));
    if (asset.error.empty()) {
      append(asset);
      continue;
    }
    arrived.messages.push_back(asset.error);
    arrived.all_good = false;
  }
  model_.append(builder_.finish());
  std::ranges::move(builder_.take_warnings(), std::back_inserter(arrived.messages));
  ratings::Options all = options_;
  all.metrics.set();  // also those that nobody has asked for, as no mesh had them
  rate(all);
  note_computed();
  return arrived;
}

void ReviewedScene::rate(const ratings::Options& options) {
  options_ = options;
  rating_ = ratings::rate(assets_, options_);
}

void ReviewedScene::note_computed() {
  for (const ratings::MeshRating& mesh : rating_.meshes)
    for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
      if (mesh.ratings[i]) computed_.set(i);
}

const analysis::InstanceAnalysis& ReviewedScene::instance(std::size_t row) const {
  const ratings::MeshRating& mesh = rating_.meshes[row];
  return assets_[mesh.asset].instances[mesh.instance];
}

const analysis::GeometryAnalysis& ReviewedScene::geometry(std::size_t row) const {
  return assets_[rating_.meshes[row].asset].geometries[instance(row).geometry];
}

std::string ReviewedScene::name(std::size_t row) const {
  const analysis::InstanceAnalysis& shown = instance(row);
  return shown.node.empty() ? shown.mesh : shown.node;
}

report::SceneReport ReviewedScene::report() const {
  report::SceneReport report;
  report.tool_version = version();
  report.options = options_;
  report.assets = assets_;
  report.rating = rating_;
  if (!assets_.empty()) {
    report.parameters = assets_.front().parameters;
    report.device = assets_.front().device;
  }
  return report;
}

}  // namespace scene_analyzer::viewer
