// pipeline_pack.cpp — The Pipeline's way of measuring several assets together.
#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

#include "pipeline/attempt.h"
#include "pipeline/pending_pack.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::pipeline {

using analysis::AssetAnalysis;

std::unique_ptr<PendingPack> Pipeline::start_pack(std::vector<std::unique_ptr<PendingAnalysis>> assets) {
  auto pack = std::make_unique<PendingPack>(std::move(assets));
  std::vector<PendingAnalysis*> to_measure = pack->measured();
  // Sets of metrics differ where some assets have an analysis file that lacks what is asked for now: what
  // such a file holds is computed again. Those like the first are measured together, the others alone.
  for (PendingAnalysis* asset : to_measure)
    if (asset->wanted_ == to_measure.front()->wanted_ &&
        asset->options_->parameters == to_measure.front()->options_->parameters)
      pack->joined_assets_.push_back(asset);
  if (pack->joined_assets_.size() < 2) pack->joined_assets_.clear();
  if (!pack->joined_assets_.empty()) try {
      measure_together(*pack);
    } catch (const std::bad_alloc&) {
      pack->measurement_.reset();  // each by itself needs less
      pack->joined_assets_.clear();
    }
  for (PendingAnalysis* asset : to_measure)
    if (std::ranges::find(pack->joined_assets_, asset) == pack->joined_assets_.end())
      attempt(asset->asset_, asset->outcome_, [&] { measure(*asset); });
  return pack;
}

void Pipeline::finish_pack(std::unique_ptr<PendingPack> pack, const Finished& finished) {
  if (pack->measurement_) try {
      complete_together(*pack);
    } catch (const std::bad_alloc&) {
      pack->measurement_.reset();
      for (PendingAnalysis* asset : pack->joined_assets_)
        attempt(asset->asset_, asset->outcome_, [&] { measure(*asset); });
    }
  // No search of one beside the timing of another.
  const bool alone =
      std::ranges::any_of(pack->assets_, [&](const auto& asset) { return is_timed_alone(*asset->options_); });
  for (const auto& asset : pack->assets_)
    if (alone && asset->measurement_)
      attempt(asset->asset_, asset->outcome_, [&] { std::exchange(asset->measurement_, nullptr)->finish(); });
  for (std::size_t i = 0; i < pack->assets_.size(); ++i) {
    PendingAnalysis& asset = *pack->assets_[i];
    if (asset.has_something_to_measure() && asset.wanted_[index_of(analysis::Metric::kRenderingTime)])
      attempt(asset.asset_, asset.outcome_, [&] { find_times(asset); });
    finished(i, finish(asset));
  }
}

void Pipeline::measure_together(PendingPack& pack) {
  pack.device_ = start_device()->stamp;
  std::vector<const mesh::Scene*> scenes;
  for (const PendingAnalysis* asset : pack.joined_assets_) scenes.push_back(&asset->scene_);
  pack.joined_ = join(scenes);
  const analysis::MetricSet wanted = pack.joined_assets_.front()->wanted_;
  const double end = wanted[index_of(analysis::Metric::kRenderingTime)] ? kTimingBegins : kTimingEnds;
  Measurement measurement{.scene = pack.joined_.scene,
                          .analysis = pack.analysis_,
                          .parameters = pack.joined_assets_.front()->options_->parameters,
                          .metrics = wanted,
                          .progress = [&pack, end](double fraction, const std::string& step) {
                            pack.report(kImportEnds + (end - kImportEnds) * fraction, step);
                          }};
  if (wanted[index_of(analysis::Metric::kRenderingTime)])
    measurement.degenerate = [&pack](std::uint32_t geometry, std::vector<std::uint32_t> triangles) {
      pack.degenerate_[geometry] = std::move(triangles);
    };
  pack.measurement_ = measurer_->start(std::move(measurement));
}

void Pipeline::complete_together(PendingPack& pack) {
  pack.measurement_->finish();
  const auto first = first_geometries(pack.joined_, pack.analysis_);
  std::vector<AssetAnalysis*> analyses;
  for (PendingAnalysis* asset : pack.joined_assets_) analyses.push_back(&*asset->outcome_.analysis);
  split(pack.joined_, std::move(pack.analysis_), analyses);
  pack.measurement_.reset();
  for (auto& [geometry, triangles] : pack.degenerate_) {
    const auto after = std::ranges::upper_bound(first, geometry);
    const auto part = static_cast<std::size_t>(after - first.begin()) - 1;
    pack.joined_assets_[part]->degenerate_[geometry - first[part]] = std::move(triangles);
  }
  for (PendingAnalysis* asset : pack.joined_assets_) asset->outcome_.analysis->device = pack.device_;
}

}  // namespace scene_analyzer::pipeline
