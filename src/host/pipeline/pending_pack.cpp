#include "pipeline/pending_pack.h"

#include <algorithm>

namespace scene_analyzer::pipeline {

std::uint64_t PendingAnalysis::triangles() const {
  std::uint64_t triangles = 0;
  for (const mesh::TriangleMesh& mesh : scene_.meshes) triangles += mesh.triangle_count();
  return triangles;
}

std::uint64_t PendingAnalysis::held_bytes() const {
  // Names, paths and what the allocator adds are guessed.
  constexpr std::uint64_t kInstance = 200, kGeometry = 600, kAsset = 4096;
  std::uint64_t bytes = kAsset + scene_.effort.answer_bytes;
  if (outcome_.analysis)
    bytes +=
        outcome_.analysis->instances.size() * kInstance + outcome_.analysis->geometries.size() * kGeometry;
  return bytes;
}

bool PendingPack::is_searching() const {
  return (measurement_ && measurement_->is_searching()) ||
         std::ranges::any_of(assets_, [](const auto& asset) { return asset->is_searching(); });
}

std::vector<PendingAnalysis*> PendingPack::measured() const {
  std::vector<PendingAnalysis*> measured;
  for (const auto& asset : assets_)
    if (asset->has_something_to_measure()) measured.push_back(asset.get());
  return measured;
}

void PendingPack::report(double fraction, const std::string& step) const {
  for (PendingAnalysis* asset : joined_assets_) asset->report(fraction, step);
}

}  // namespace scene_analyzer::pipeline
