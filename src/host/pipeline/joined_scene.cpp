#include "pipeline/joined_scene.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace scene_analyzer::pipeline {

JoinedScene join(std::span<const mesh::Scene* const> parts) {
  JoinedScene joined;
  for (const mesh::Scene* part : parts) {
    const auto first = static_cast<std::uint32_t>(joined.scene.meshes.size());
    joined.first_meshes.push_back(first);
    joined.scene.meshes.insert(joined.scene.meshes.end(), part->meshes.begin(), part->meshes.end());
    for (const mesh::Instance& instance : part->instances) {
      joined.scene.instances.push_back(instance);
      joined.scene.instances.back().mesh += first;
    }
  }
  joined.first_meshes.push_back(static_cast<std::uint32_t>(joined.scene.meshes.size()));
  return joined;
}

std::vector<std::uint32_t> first_geometries(const JoinedScene& joined,
                                            const analysis::AssetAnalysis& measured) {
  // Geometries are in order of first use, and instances part by part: no part's begin before another's end.
  std::vector<std::uint32_t> first;
  for (const std::uint32_t mesh : joined.first_meshes) {
    const auto begin = std::ranges::partition_point(
        measured.geometries, [&](const auto& geometry) { return geometry.mesh < mesh; });
    first.push_back(static_cast<std::uint32_t>(std::distance(measured.geometries.begin(), begin)));
  }
  return first;
}

void split(const JoinedScene& joined, analysis::AssetAnalysis&& measured,
           std::span<analysis::AssetAnalysis* const> parts) {
  const std::vector<std::uint32_t> first = first_geometries(joined, measured);
  auto instance = std::make_move_iterator(measured.instances.begin());
  const auto end = std::make_move_iterator(measured.instances.end());
  for (std::size_t part = 0; part < parts.size(); ++part) {
    analysis::AssetAnalysis& to = *parts[part];
    to.geometries.assign(std::make_move_iterator(measured.geometries.begin() + first[part]),
                         std::make_move_iterator(measured.geometries.begin() + first[part + 1]));
    for (auto& geometry : to.geometries) geometry.mesh -= joined.first_meshes[part];
    to.instances.clear();
    for (; instance != end && instance.base()->geometry < first[part + 1]; ++instance) {
      to.instances.push_back(*instance);
      to.instances.back().geometry -= first[part];
    }
  }
}

}  // namespace scene_analyzer::pipeline
